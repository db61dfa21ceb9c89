"""Fits drag laws to rows of resolved flow: what `polybed fit` hands over to."""
