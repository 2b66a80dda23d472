incognita_room(analysis SOURCES analysis/pose_consistency.cpp analysis/trajectory.cpp USES incognita::math)
