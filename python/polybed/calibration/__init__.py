"""The study behind `polybed calibrate`: boxes of particles are run, and a table of the solids stress is fitted to what they measure."""
