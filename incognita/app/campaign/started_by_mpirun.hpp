// Whether this process is one of several.
#pragma once

#include <cstdlib>

namespace incognita {

/// By what the starters of OpenMPI, MPICH and Slurm put into the environment.
inline bool started_by_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size) > 1;
  return false;
}

}  // namespace incognita
