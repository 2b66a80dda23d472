// Whether this process is one of several started by mpirun.
#pragma once

#include <cstdlib>

namespace incognita {

/// Checks the environment variables set by OpenMPI, MPICH and Slurm.
inline bool started_by_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size) > 1;
  return false;
}

}  // namespace incognita
