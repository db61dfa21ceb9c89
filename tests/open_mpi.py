"""What Open MPI needs in a container and as root, for the scripts that start mpirun. multiscale/program.cpp sets the same
for `polybed -n`, and tests/CMakeLists.txt for test programs that it starts itself."""
import os
import pathlib

# Two ranks are enough for the short form of a nightly test.
SHORT = os.environ.get("POLYBED_NIGHTLY") == "0"
SETTINGS = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
            "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
            # All ranks are on this machine and bound to no core: libraries of networks, OpenGL and OpenCL are not loaded and the
            # machine is not mapped, which takes half of the time to start.
            "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self,vader", "OMPI_MCA_osc": "^ucx",
            "HWLOC_COMPONENTS": "no_os,stop", "HWLOC_PLUGINS_PATH": "/nonexistent"}
# For more ranks than cores: one that waits lets another compute.
MORE_THAN_CORES = {"OMPI_MCA_mpi_yield_when_idle": "1"}
# For a process that starts no ranks.
ONE_PROCESS = {"OMPI_MCA_mca_base_param_files": str(pathlib.Path(__file__).with_name("one_process.conf"))}
