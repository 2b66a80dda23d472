incognita_test(slam_test SOURCES allocations.cpp slam/association_test.cpp slam/bundle_test.cpp slam/keyframes_test.cpp slam/point_in_view_test.cpp slam/renew_map_test.cpp slam/two_view_start_test.cpp slam/pixel_noise_test.cpp slam/rolling_shutter_test.cpp slam/camera_estimator_test.cpp slam/consensus_test.cpp slam/wheel_odometry_update_test.cpp slam/map_management_test.cpp slam/patch_plane_test.cpp slam/align_rotation_test.cpp slam/automatic_settings_test.cpp slam/second_order_test.cpp slam/pose_hypotheses_test.cpp slam/single_vehicle_test.cpp slam/solve_pose_test.cpp slam/target_picture_test.cpp slam/team_association_test.cpp slam/team_estimator_test.cpp
               slam/team_measurements_test.cpp slam/tracking_test.cpp slam/entropy_test.cpp slam/prune_landmarks_test.cpp slam/relative_sigma_test.cpp USES incognita::slam)
incognita_test(camera_slam_test SOURCES slam/active_search_test.cpp slam/camera_lost_test.cpp slam/camera_start_test.cpp
               slam/corner_choice_test.cpp slam/depth_line_failure_test.cpp slam/depth_line_test.cpp slam/expected_matches_test.cpp
               slam/landmark_initialization_test.cpp slam/landmark_upkeep_test.cpp slam/relocalization_test.cpp
               USES incognita::slam)
incognita_test(camera_consistency_test SOURCES slam/camera_consistency_test.cpp USES incognita::io incognita::slam incognita::world)
