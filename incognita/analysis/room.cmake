incognita_room(analysis SOURCES analysis/linear_system.cpp analysis/map_error.cpp analysis/pose_consistency.cpp analysis/trajectory.cpp USES incognita::math)
