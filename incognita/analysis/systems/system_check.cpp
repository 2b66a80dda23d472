#include "incognita/analysis/systems/system_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "incognita/analysis/systems/expression_guard.hpp"
#include "incognita/math/nearest_name.hpp"

namespace incognita {
namespace {

using Names = std::vector<std::string>;

constexpr std::size_t most_states = 64, most_measurements = 64, most_definitions = 256, most_others = 64;
constexpr std::size_t longest_name = 40, longest_title = 80;

bool is_identifier(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto inside = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.size() <= longest_name && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), inside);
}

void need_identifier(const std::string& name, SourceLocation location) {
  if (!is_identifier(name))
    throw SystemError(location, quoted_name(name) +
                                    " is not a name; a name is a letter followed by letters, digits and _, " +
                                    std::to_string(longest_name) + " characters at most");
}

/// Titles of motions, directions and errors: any printable text on one line.
void need_title(const std::string& title, SourceLocation location) {
  const bool printable = std::none_of(
      title.begin(), title.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  if (title.empty() || title.size() > longest_title || !printable)
    throw SystemError(location, "a name of 1 to " + std::to_string(longest_title) +
                                    " characters on one line is required, not " + quoted_name(title));
}

template <class T>
void need_few(const std::vector<T>& items, std::size_t most, const std::string& what) {
  if (items.size() > most)
    throw SystemError(items[most].location, "there are " + std::to_string(items.size()) + " " + what +
                                                "; at most " + std::to_string(most) + " are allowed");
}

template <class T>
Names names_of(const std::vector<T>& items) {
  Names names;
  for (const T& item : items) names.push_back(item.name);
  return names;
}

Names operator+(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string with_nearest(const std::string& problem, const std::string& name, const Names& names) {
  return problem + (names.empty() ? "" : "; the nearest is " + quoted_name(nearest_name(name, names)));
}

/// Requires each name to be one of `known`, without duplicates.
template <class T>
void need_known(const std::vector<T>& items, const Names& known, const std::string& what) {
  std::set<std::string> seen;
  for (const T& item : items) {
    if (!contains(known, item.name))
      throw SystemError(item.location,
                        with_nearest("there is no " + what + " " + quoted_name(item.name), item.name, known));
    if (!seen.insert(item.name).second)
      throw SystemError(item.location, quoted_name(item.name) + " occurs twice");
  }
}

void need_ranges(const std::vector<NamedRange>& ranges) {
  for (const NamedRange& range : ranges) {
    if (!std::isfinite(range.low) || !std::isfinite(range.high) || !std::isfinite(range.high - range.low))
      throw SystemError(range.location, "the range of " + quoted_name(range.name) + " must be finite");
    if (range.low > range.high)
      throw SystemError(range.location,
                        "the range of " + quoted_name(range.name) + " is empty; write [lowest, highest]");
  }
}

/// The names visible to an expression.
class Scope {
 public:
  void add(const std::string& what, const std::string& name, SourceLocation location) {
    need_identifier(name, location);
    // `landmark` and `draw` are keywords of the tables that assign values to states
    if (is_reserved_name(name) || name == "landmark" || name == "draw")
      throw SystemError(location, quoted_name(name) + " is reserved; choose another name");
    const auto [at, added] = owners_.insert({name, {what, location}});
    if (!added) {
      const Owner& owner = at->second;
      const std::string line =
          owner.location.line > 0 ? ", in line " + std::to_string(owner.location.line) : "";
      throw SystemError(location, "there is " + owner.what + " " + quoted_name(name) + " already" + line);
    }
    names_.insert(std::lower_bound(names_.begin(), names_.end(), name), name);
  }

  template <class T>
  void add_all(const std::string& what, const std::vector<T>& items) {
    for (const T& item : items) add(what, item.name, item.location);
  }

  void check(const ExpressionText& expression) const {
    try {
      checked_tokens(expression.text, names_);
    } catch (const ExpressionError& error) {
      throw SystemError(location_in(expression, error.offset), error.what());
    }
  }

  template <class T>
  void check_all(const std::vector<T>& items) const {
    for (const T& item : items) check(item.expression);
  }

 private:
  struct Owner {
    std::string what;  ///< "a state"
    SourceLocation location;
  };
  Names names_;  ///< sorted
  std::map<std::string, Owner> owners_;
};

class SystemCheck {
 public:
  explicit SystemCheck(const SystemText& system) : system_(system) {}

  void run() {
    check_head();
    check_parameters();
    vehicle_.add_all("an input", system_.inputs);
    check_block(system_.vehicle, "", vehicle_);
    need_known(system_.disturbed, names_of(system_.vehicle.states), "state");
    check_landmark();
    check_anchor();
    need_something_to_observe();
    need_known(system_.disturbed, names_of(system_.vehicle.states), "state of the vehicle");
    need_few(system_.motions, most_others, "motions");
    for (const MotionText& motion : system_.motions) check_motion(motion);
    check_directions(system_.directions, system_.landmark_directions);
    if (system_.error_form) check_error_form(*system_.error_form);
  }

 private:
  void check_head() const {
    if (system_.representation != "world" && system_.representation != "relative")
      throw SystemError(
          {}, "representation must be `world` or `relative`, and is " + quoted_name(system_.representation));
    if (!(system_.segment_duration_s > 0) || !std::isfinite(system_.segment_duration_s))
      throw SystemError({}, "segment_duration_s must be finite and more than 0");
  }

  void check_parameters() {
    need_few(system_.parameters, most_definitions, "parameters");
    need_few(system_.inputs, most_others, "inputs");
    for (const NamedNumber& parameter : system_.parameters) {
      if (!std::isfinite(parameter.value))
        throw SystemError(parameter.location, quoted_name(parameter.name) + " must be finite");
    }
    need_ranges(system_.inputs);
    vehicle_.add_all("a parameter", system_.parameters);
  }

  /// Adds the block's names to the scope, and checks all but its error rows. `section`: prefix of its section names.
  static void check_block(const BlockText& block, const std::string& section, Scope& scope) {
    need_few(block.states, most_states, "states");
    need_few(block.definitions, most_definitions, "definitions");
    need_few(block.measurements, most_measurements, "measurements");
    need_ranges(block.region);
    // First, so that a missing equation is not reported as an unknown name
    if (!block.states.empty() || !block.region.empty()) check_region(block, section);
    scope.add_all("a state", block.states);
    for (const NamedExpression& definition : block.definitions) {
      scope.check(definition.expression);
      scope.add("a definition", definition.name, definition.location);
    }
    scope.check_all(block.states);
    for (const MeasurementText& measurement : block.measurements) check_measurement(measurement, scope);
    need_known(block.measurements, names_of(block.measurements), "measurement");
  }

  static void check_measurement(const MeasurementText& measurement, const Scope& scope) {
    need_identifier(measurement.name, measurement.location);
    scope.check(measurement.expression);
    if (!(measurement.sigma > 0) || !std::isfinite(measurement.sigma))
      throw SystemError(measurement.location,
                        "sigma of " + quoted_name(measurement.name) + " must be finite and more than 0");
  }

  static void check_region(const BlockText& block, const std::string& section) {
    const Names states = names_of(block.states), ranges = names_of(block.region);
    if (states.empty())
      throw SystemError(block.region[0].location, "the region contains " + quoted_name(ranges[0]) +
                                                      ", but there are no states; write " + ranges[0] +
                                                      " = \"its rate of change\" under [" + section +
                                                      "states]");
    for (const NamedRange& range : block.region) {
      if (!contains(states, range.name))
        throw SystemError(
            range.location,
            with_nearest("state " + quoted_name(range.name) + " has no equation", range.name, states));
    }
    need_known(block.region, states, "state");
    for (const NamedExpression& state : block.states) {
      if (!contains(ranges, state.name))
        throw SystemError(state.location, "state " + quoted_name(state.name) + " has no region; write " +
                                              state.name + " = [lowest, highest] under [" + section +
                                              "region]");
    }
  }

  void check_landmark() {
    landmark_ = vehicle_;
    if (!system_.landmark) return;
    if (system_.landmark->states.empty())
      throw SystemError({}, "a landmark needs a state; a landmark with known position is an anchor");
    check_block(*system_.landmark, "landmark.", landmark_);
    need_distinct_names();
  }

  /// State y of landmark 1 is displayed as y_1.
  void need_distinct_names() const {
    for (const NamedExpression& state : system_.vehicle.states) {
      const std::size_t bar = state.name.rfind('_');
      if (bar == std::string::npos || bar + 1 == state.name.size()) continue;
      const bool number = state.name.find_first_not_of("0123456789", bar + 1) == std::string::npos;
      if (number && contains(landmark_states(), state.name.substr(0, bar)))
        throw SystemError(state.location, quoted_name(state.name) + " is the displayed name of state " +
                                              quoted_name(state.name.substr(0, bar)) +
                                              " of a landmark; choose another name");
    }
  }

  void check_anchor() {
    anchor_ = vehicle_;
    if (!system_.anchor) return;
    BlockText known = *system_.anchor;
    if (!known.states.empty())
      throw SystemError(known.states[0].location, "an anchor has constants, not states");
    need_few(known.region, most_states, "constants");
    need_ranges(known.region);
    anchor_.add_all("a constant", known.region);
    known.region.clear();
    check_block(known, "anchor.", anchor_);
  }

  void need_something_to_observe() const {
    const auto measures = [](const std::optional<BlockText>& b) { return b && !b->measurements.empty(); };
    if (system_.vehicle.states.empty() && !system_.landmark)
      throw SystemError({}, "the system has no states; write x = \"its rate of change\" under [states]");
    if (system_.vehicle.measurements.empty() && !measures(system_.landmark) && !measures(system_.anchor))
      throw SystemError({},
                        "the system has no measurement; write one under [measurements], "
                        "[landmark.measurements] or [anchor.measurements]");
  }

  void check_motion(const MotionText& motion) const {
    need_title(motion.name, motion.location);
    if (motion.name == "general")
      throw SystemError(motion.location, "every system has the motion `general`; choose another name");
    need_few(motion.draws, most_others, "draws");
    need_known(motion.assignments, names_of(system_.vehicle.states) + names_of(system_.inputs),
               "state or input");
    need_ranges(motion.draws);
    Scope scope = vehicle_;
    scope.add_all("a draw", motion.draws);
    scope.check_all(motion.assignments);
  }

  Names landmark_states() const { return system_.landmark ? names_of(system_.landmark->states) : Names{}; }

  void check_directions(const std::vector<DirectionText>& common,
                        const std::vector<DirectionText>& of_landmark) const {
    need_few(common, most_others, "directions");
    need_few(of_landmark, most_others, "directions");
    need_known(common, names_of(common), "direction");
    need_known(of_landmark, names_of(of_landmark), "direction");
    for (const DirectionText& direction : common)
      check_direction(direction, names_of(system_.vehicle.states));
    for (const DirectionText& direction : of_landmark) {
      if (contains(names_of(common), direction.name))
        throw SystemError(direction.location,
                          "there is a direction " + quoted_name(direction.name) + " already");
      check_direction(direction, {});
    }
  }

  void check_direction(const DirectionText& direction, const Names& vehicle_states) const {
    need_title(direction.name, direction.location);
    need_known(direction.vehicle, vehicle_states, "state");
    need_known(direction.landmark, landmark_states(), "landmark state");
    vehicle_.check_all(direction.vehicle);
    landmark_.check_all(direction.landmark);
    if (direction.vehicle.empty() && direction.landmark.empty())
      throw SystemError(direction.location, "direction " + quoted_name(direction.name) +
                                                " is empty: it needs a vehicle or landmark state");
  }

  void check_error_form(const ErrorFormText& form) const {
    const Names vehicle = names_of(system_.vehicle.states), both = vehicle + landmark_states();
    need_known(form.names, both, "state");
    std::set<std::string> taken;
    for (const NamedExpression& error : form.names) {
      need_title(error.expression.text, error.expression.location);
      if (!taken.insert(error.expression.text).second)
        throw SystemError(error.expression.location,
                          "there is an error " + quoted_name(error.expression.text) + " already");
    }
    check_directions(form.directions, form.landmark_directions);
    check_error_rows(system_.vehicle, vehicle, vehicle_);
    if (system_.landmark) check_error_rows(*system_.landmark, both, landmark_);
    if (system_.anchor) check_error_rows(*system_.anchor, vehicle, anchor_);
  }

  /// A missing row of a state is 0. A missing row of a measurement is an error, since it would measure nothing.
  static void check_error_rows(const BlockText& block, const Names& columns, const Scope& scope) {
    need_known(block.error_F, names_of(block.states), "state");
    need_known(block.error_H, names_of(block.measurements), "measurement");
    for (const auto* rows : {&block.error_F, &block.error_H}) {
      for (const SparseRow& row : *rows) {
        need_known(row.entries, columns, "state");
        scope.check_all(row.entries);
      }
    }
    for (const MeasurementText& measurement : block.measurements) {
      if (!contains(names_of(block.error_H), measurement.name))
        throw SystemError(measurement.location,
                          "the error form has no row for measurement " + quoted_name(measurement.name));
    }
  }

  const SystemText& system_;
  Scope vehicle_, landmark_, anchor_;
};

}  // namespace

void check_system(const SystemText& system) { SystemCheck(system).run(); }

std::string quoted_name(const std::string& name) {
  constexpr std::size_t most = 60;
  std::size_t length = std::min(name.size(), most);
  while (length > 0 && length < name.size() && (name[length] & 0xc0) == 0x80)
    --length;  // not inside a UTF-8 character
  std::string shown = name.substr(0, length);
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return "`" + shown + (length < name.size() ? "...`" : "`");
}

SourceLocation location_in(const ExpressionText& expression, int offset) {
  const bool has_location = expression.location.column > 0 && expression.text.find('\n') == std::string::npos;
  return {expression.location.line, expression.location.column + (has_location ? offset : 0)};
}

}  // namespace incognita
