incognita_room(belief
               SOURCES belief/belief.cpp belief/cholesky.cpp belief/dropped_correlations.cpp belief/inflation.cpp
                       belief/information_belief.cpp belief/information_update.cpp belief/joseph.cpp
                       belief/rank_update.cpp belief/rank_update_baseline.cpp belief/reverse_factor.cpp
                       belief/state_layout.cpp belief/triangle.cpp belief/update.cpp belief/whole_map.cpp
               USES incognita::math)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # Only these two files may use newer instructions; rank_update.cpp asks the processor before calling them.
  target_sources(incognita_belief PRIVATE belief/rank_update_avx2.cpp belief/rank_update_avx512.cpp)
  set_source_files_properties(belief/rank_update_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma;-ffp-contract=fast")
  set_source_files_properties(belief/rank_update_avx512.cpp PROPERTIES COMPILE_OPTIONS "-mavx512f;-ffp-contract=fast")
  set_source_files_properties(belief/rank_update_avx2.cpp belief/rank_update_avx512.cpp
                              PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  set_source_files_properties(belief/rank_update.cpp PROPERTIES COMPILE_DEFINITIONS INCOGNITA_X86_PATHS)
endif()
