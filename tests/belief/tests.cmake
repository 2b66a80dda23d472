incognita_test(belief_test
  SOURCES allocations.cpp belief/dense.cpp belief/update_test.cpp belief/structure_test.cpp belief/chart_test.cpp
          belief/refusal_test.cpp belief/endurance_test.cpp belief/inflation_test.cpp belief/information_test.cpp belief/rank_update_test.cpp
          belief/aligned_buffer_test.cpp belief/allocation_test.cpp belief/linearize_test.cpp belief/iterated_test.cpp belief/trace_test.cpp belief/map_frame_test.cpp
          belief/saved_belief_test.cpp belief/tiled_cholesky_test.cpp
  USES incognita::belief)
