incognita_room(slam
  SOURCES slam/association.cpp slam/belief_entropy.cpp slam/birth.cpp slam/camera_estimator.cpp slam/camera_validation.cpp slam/consensus.cpp slam/depth_line.cpp
          slam/entropy.cpp slam/follow_wheels.cpp slam/landmark_position.cpp slam/learn_planes.cpp slam/map_management.cpp slam/measure.cpp
          slam/patch_plane.cpp slam/planar_association.cpp slam/planar_estimate.cpp slam/planar_estimator.cpp
          slam/planar_looks.cpp slam/planar_motion.cpp slam/predict_looks.cpp slam/solve_pose.cpp slam/target_picture.cpp slam/target_pose.cpp
          slam/team_association.cpp slam/team_estimator.cpp slam/team_fault.cpp slam/team_looks.cpp slam/team_motion.cpp slam/tracking.cpp
  USES incognita::belief incognita::models incognita::messages incognita::vision
  PRIVATE_USES opencv_calib3d opencv_core)
