find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)

# incognita_program_test(NAME SOURCES... USES...): runs the built program as a child process
function(incognita_program_test name)
  incognita_test(${name} ${ARGN})
  target_sources(${name} PRIVATE app/program.cpp)
  target_link_libraries(${name} PRIVATE incognita::messages nlohmann_json::nlohmann_json)
  target_compile_definitions(${name} PRIVATE INCOGNITA_PROGRAM="$<TARGET_FILE:incognita_program>"
                                             INCOGNITA_VERSION="${PROJECT_VERSION}")
  add_dependencies(${name} incognita_program)
endfunction()

incognita_program_test(program_test
                       SOURCES app/program_usage_test.cpp app/program_scenario_test.cpp app/program_run_test.cpp
                               app/program_disk_test.cpp app/program_adjust_test.cpp app/program_evaluate_test.cpp app/program_observe_test.cpp
                               app/program_reproduce_test.cpp app/program_interventions_test.cpp)
# Separate, since it alone renders and writes images: the others start faster without those libraries
incognita_program_test(program_recording_test SOURCES app/program_recording_test.cpp
                       USES incognita::io incognita::world opencv_core opencv_imgcodecs fmt::fmt)
# Separate, since they alone render boards and sheets
incognita_program_test(program_calibrate_test SOURCES app/near_sheet_test.cpp app/program_calibrate_test.cpp app/program_target_test.cpp
                       USES incognita::calibration incognita::io incognita::targets opencv_core opencv_imgcodecs opencv_videoio)
incognita_test(target_start_test SOURCES app/target_start_test.cpp USES incognita::io incognita::slam incognita::world)
incognita_test(davison_test SOURCES app/davison_test.cpp USES incognita::app opencv_imgproc opencv_core)
incognita_test(reproduce_test SOURCES app/reproduce_test.cpp
               USES incognita_app_reproduce incognita::experiments CLI11::CLI11 nlohmann_json::nlohmann_json)
incognita_program_test(program_live_test SOURCES app/program_live_test.cpp USES opencv_core opencv_imgcodecs opencv_videoio)
# Links modules of the library, like program_recording_test
incognita_program_test(program_resume_test SOURCES app/program_resume_test.cpp USES incognita::record)
incognita_program_test(program_ranges_test SOURCES app/program_ranges_test.cpp USES incognita::io incognita::world)
incognita_test(car_park_test SOURCES app/car_park_test.cpp USES incognita::app incognita::analysis)
incognita_test(observability_watch_test SOURCES app/observability_watch_test.cpp USES incognita::app)
incognita_test(team_test SOURCES app/team_test.cpp USES incognita::control incognita::world)
incognita_test(team_recording_test SOURCES app/team_recording_test.cpp USES incognita::app)
incognita_test(point_scenario_test SOURCES app/point_scenario_test.cpp app/point_scenario_runs_test.cpp
                                           app/model_combinations_test.cpp USES incognita::app fmt::fmt)
incognita_program_test(program_team_test SOURCES app/program_team_test.cpp
                       USES incognita::record fmt::fmt)
# Separate, since it alone kills the programs that it starts
incognita_program_test(program_campaign_test SOURCES app/program_campaign_test.cpp
                                                     app/program_campaign_interrupted_test.cpp)
incognita_test(map_truth_test SOURCES app/map_truth_test.cpp USES incognita::app)
incognita_test(withheld_truth_test SOURCES app/withheld_truth_test.cpp USES incognita::app)
incognita_test(relocalization_in_room_test SOURCES app/relocalization_in_room_test.cpp USES incognita::app)
incognita_test(loop_closure_in_room_test SOURCES app/loop_closure_in_room_test.cpp USES incognita::app)
incognita_test(run_description_test SOURCES app/run_description_test.cpp USES incognita::app)
incognita_test(map_room_test SOURCES app/map_room_test.cpp USES incognita::app)
incognita_test(room_vehicle_test SOURCES app/room_vehicle_test.cpp USES incognita::app)
incognita_test(hand_held_test SOURCES app/hand_held_test.cpp USES incognita::app)
incognita_test(room_motion_test SOURCES app/room_motion_test.cpp USES incognita::app fmt::fmt)
incognita_test(combinations_test SOURCES app/combinations_test.cpp app/sensor_combinations_test.cpp USES incognita::app)
incognita_test(laboratory_test SOURCES app/laboratory_test.cpp USES incognita_app_laboratory)
# Compiles what the program alone contains
incognita_test(failed_tick_test SOURCES app/failed_tick_test.cpp
                                        ${PROJECT_SOURCE_DIR}/incognita/app/loop/scenario_run.cpp
               USES incognita::app fmt::fmt)
target_compile_definitions(failed_tick_test PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")
incognita_test(saved_parts_test SOURCES app/saved_parts_test.cpp USES incognita::decision incognita::control incognita::world)
incognita_test(resume_test SOURCES app/resume_test.cpp ${PROJECT_SOURCE_DIR}/incognita/app/loop/scenario_run.cpp
               USES incognita::app fmt::fmt)
target_compile_definitions(resume_test PRIVATE INCOGNITA_VERSION="${PROJECT_VERSION}")
incognita_test(live_control_test SOURCES app/live_control_test.cpp USES incognita_app_view)
incognita_test(robot_controller_test SOURCES app/robot_controller_test.cpp USES incognita::app)
incognita_test(simulated_robot_test SOURCES app/simulated_robot_test.cpp USES incognita_app_robot)
incognita_program_test(program_robot_test SOURCES app/program_robot_test.cpp)
# Four interruptions of the link to a simulated robot, one of each kind, after which navigation goes on; in real time, hence alone
add_test(NAME app.robot_link_interrupted
         COMMAND ${PROJECT_SOURCE_DIR}/tools/evaluate-robot-link --trials 4 --after 2
                 --program $<TARGET_FILE:incognita_program> --out ${CMAKE_CURRENT_BINARY_DIR}/robot_link)
set_tests_properties(app.robot_link_interrupted PROPERTIES TIMEOUT 600 RUN_SERIAL TRUE)
