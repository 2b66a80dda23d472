# `incognita campaign`. Uses MPI if it is found; without it only `mpirun` is unavailable.
option(INCOGNITA_MPI "Spread campaigns with mpirun, where MPI is found" ON)
set(ranks app/campaign/ranks_alone.cpp)
if(INCOGNITA_MPI)
  set(MPI_CXX_SKIP_MPICXX TRUE)  # only the C functions are used
  find_package(MPI QUIET COMPONENTS CXX)
  if(MPI_CXX_FOUND)
    set(ranks app/campaign/ranks_mpi.cpp)
    target_link_libraries(incognita_program PRIVATE MPI::MPI_CXX)
  endif()
endif()
file(GLOB campaign_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/app/campaign/*.cpp)
list(FILTER campaign_sources EXCLUDE REGEX "/ranks_")
target_sources(incognita_program PRIVATE app/commands/campaign.cpp ${campaign_sources} ${ranks})
find_package(Boost 1.74 REQUIRED)  # headers only: checksums
find_package(nlohmann_json REQUIRED)
target_link_libraries(incognita_program PRIVATE Boost::headers nlohmann_json::nlohmann_json)
