# shellcheck shell=bash
# Sourced by the scripts that run the tool or its tests.

# Open MPI refuses to start as root unless told twice; containers and CI machines often have no other user.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# Tests run on two ranks, on machines with one core too.
export OMPI_MCA_rmaps_base_oversubscribe=1
# Containers forbid the system call by which ranks read each other's memory; without this each run prints a warning.
export OMPI_MCA_btl_vader_single_copy_mechanism=none
# One thread per rank: threads of BLAS or OpenMP beside ranks only get in each other's way.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
