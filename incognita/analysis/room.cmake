incognita_room(analysis
  SOURCES analysis/closed_loop.cpp analysis/expression_guard.cpp analysis/expression_postfix.cpp analysis/linear_system.cpp
          analysis/map_error.cpp analysis/median.cpp analysis/null_space.cpp analysis/observability_monitor.cpp
          analysis/observability_report.cpp analysis/pose_consistency.cpp
          analysis/row_sum.cpp analysis/run_consistency.cpp analysis/statistics.cpp
          analysis/symmetries.cpp analysis/system_check.cpp analysis/trajectory.cpp
  USES incognita::math incognita::models incognita::belief PRIVATE_USES Boost::headers)

# Systems that a user writes down: a target of its own, so that whoever wants trajectories pulls no computer algebra
find_package(PkgConfig REQUIRED)
pkg_check_modules(GINAC REQUIRED IMPORTED_TARGET GLOBAL ginac)
incognita_room(systems
  SOURCES analysis/assignment_order.cpp analysis/canonical_expression.cpp analysis/explain_observability.cpp analysis/expression_graph.cpp
          analysis/latex_names.cpp analysis/lie_algebra.cpp analysis/lie_derivatives.cpp analysis/motion_inputs.cpp
          analysis/observability.cpp
          analysis/observability_latex.cpp analysis/observability_matrices.cpp analysis/parse_expression.cpp
          analysis/symbolic_system.cpp analysis/system_instance.cpp analysis/system_motion.cpp analysis/tape.cpp
  USES incognita::analysis PRIVATE_USES PkgConfig::GINAC Boost::headers)
