#include "experiments/observability_claims.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>

#include "incognita/analysis/observability/lie_derivatives.hpp"
#include "incognita/analysis/observability/observability_matrices.hpp"
#include "incognita/io/formats/system_file.hpp"

namespace incognita::observability_claims {
namespace {

constexpr char stream[] = "operating points";  // as analyze_observability() names it

double usual_segment_s(const std::string& system) {
  return system.starts_with("planar") || system == "monobot" ? 1 : in_space_s;
}

SystemText text_of(const Case& which) {
  SystemText text = load_system(which.system, which.representation);
  text.segment_duration_s = which.segment_s > 0 ? which.segment_s : usual_segment_s(which.system);
  if (which.change.apply) which.change.apply(text);
  return text;
}

struct Instance {
  SymbolicSystem system;
  SystemInstance numbers;
  explicit Instance(const Case& which)
      : system(make_symbolic(text_of(which), which.motion)), numbers(system, which.features, which.anchors) {}
};

SystemMotion motion_of(const SystemInstance& instance, const Case& which, int seed) {
  RandomStream random(static_cast<std::uint64_t>(seed), stream);
  return draw_motion(instance, which.segments, random);
}

Course course_of(const SystemInstance& instance, const SystemMotion& motion) {
  Course course{{}, {}, {}, true, instance.directions(motion.segments[0].start, false)};
  for (const MotionSegment& segment : motion.segments) {
    course.points.push_back(segment.start);
    course.forms.push_back(instance.error_form(segment.start));
    course.exact.push_back(instance.linearize(segment.start));
    const LinearizedSystem& form = course.forms.back();
    course.stays = course.stays && null_space_stays(form, null_space(segment_observability(form)));
  }
  return course;
}

std::vector<int> dimensions_of(const std::vector<Spaces>& by_segment) {
  std::vector<int> all;
  for (const Spaces& spaces : by_segment) all.push_back(dimension(spaces));
  return all;
}

/// Columns count as parallel when they differ by less than this share.
constexpr double parallel = 1e-6;

Eigen::Index rank_of(const MatrixXd& columns) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
  qr.setThreshold(parallel);
  return qr.rank();
}

MatrixXd normalized(const Basis& vectors, const VectorXd& scale) {
  MatrixXd V(scale.size(), static_cast<Eigen::Index>(vectors.size()));
  for (Eigen::Index j = 0; j < V.cols(); ++j)
    V.col(j) = vectors[static_cast<std::size_t>(j)].cwiseQuotient(scale).normalized();
  return V;
}

/// The number that all have, or no_dimension.
int agreed(const std::vector<Eigen::Index>& numbers) {
  if (numbers.empty()) return no_dimension;
  const auto as_first = [&](Eigen::Index n) { return n == numbers[0]; };
  return std::ranges::all_of(numbers, as_first) ? static_cast<int>(numbers[0]) : no_dimension;
}

std::string key_of(const Case& c) {
  return fmt::format("{} {} {} {} {} {} {} {}", c.system, c.representation, c.features, c.anchors, c.motion,
                     c.change.name, c.segments, c.segment_s);
}

Studies by_number_of(const std::string& what, int Case::*number, std::initializer_list<int> numbers,
                     Case which) {
  Studies all("by " + what);
  for (const int n : numbers) {
    which.*number = n;
    all.add(std::to_string(n) + ":", study(which));
  }
  return all;
}

}  // namespace

Change turning() {
  return {"turning", [](SystemText& text) {
            for (MotionText& motion : text.motions)
              if (motion.name == "stationary")
                std::erase_if(motion.assignments, [](const NamedExpression& a) {
                  return a.name == "omega" || a.name.front() == 'w';
                });
          }};
}

Change feature_within(const std::string& name, const Vector2d& ahead, const Vector2d& left) {
  return {name, [=](SystemText& text) {
            for (NamedRange& range : text.vehicle.region) range.low = range.high = 0;
            auto& region = text.landmark->region;
            region[0].low = ahead[0], region[0].high = ahead[1];
            region[1].low = left[0], region[1].high = left[1];
          }};
}

Vectors always(const Basis& vectors) {
  return [=](const Course&) { return vectors; };
}

Vectors named(const std::vector<std::string>& names) {
  return [=](const Course& course) {
    Basis all;
    for (const std::string& name : names)
      for (const NamedDirection& direction : course.directions)
        if (direction.name.starts_with(name)) all.push_back(direction.vector);
    return all;
  };
}

Vectors about_anchor(const std::vector<std::string>& names) {
  return [=](const Course& course) {
    Basis all = named(names)(course);
    const Basis along = named({"translation along x", "translation along y"})(course);
    const VectorXd& anchor = course.points[0].anchors;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vector2d moved =
          names[i] == "scale" ? Vector2d(anchor.head<2>()) : Vector2d(-anchor[1], anchor[0]);
      all[i] -= moved.x() * along[0] + moved.y() * along[1];
    }
    return all;
  };
}

Study::Study(Case which) : which_(std::move(which)) {
  const Instance made(which_);
  const SystemInstance& instance = made.numbers;
  states_ = instance.names();
  error_states_ = instance.error_names();
  stripped_.resize(static_cast<std::size_t>(which_.segments));
  total_.resize(stripped_.size());
  for (int seed = 1; seed <= motions; ++seed) {
    const SystemMotion motion = motion_of(instance, which_, seed);
    courses_.push_back(course_of(instance, motion));
    std::vector<double> durations;
    for (const MotionSegment& segment : motion.segments) durations.push_back(segment.duration_s);
    const auto& forms = courses_.back().forms;
    const auto Q = segment_observability(forms);
    const auto stripped = stripped_observability(Q), total = total_observability(Q, forms, durations);
    for (std::size_t k = 0; k < stripped_.size(); ++k) {
      stripped_[k].push_back(null_space(stripped[k]));
      total_[k].push_back(null_space(total[k]));
    }
  }
}

const Spaces& Study::along() const {
  if (!along_.empty()) return along_;
  const Instance made(which_);
  const SystemInstance& instance = made.numbers;
  // enough measurements that the rank is not limited by the number of rows
  const int per_segment =
      std::max(4, 3 * instance.states() / (instance.measurements() * which_.segments) + 1);
  for (int seed = 1; seed <= motions; ++seed) {
    const auto samples = follow(instance, motion_of(instance, which_, seed), per_segment);
    along_.push_back(null_space(local_observability(instance, samples, false)));
  }
  return along_;
}

int Study::left(int k) const { return dimension(stripped(k)); }
std::vector<std::string> Study::observable(int k) const {
  return observable_states(stripped(k), error_states_);
}
int Study::true_dimension() const { return dimension(along()); }
std::vector<std::string> Study::observable_along() const { return observable_states(along(), states_); }
std::vector<int> Study::dimensions() const { return dimensions_of(stripped_); }
std::vector<int> Study::total_dimensions() const { return dimensions_of(total_); }

bool Study::stays() const {
  return std::ranges::all_of(courses_, [](const Course& c) { return c.stays; });
}

bool Study::same_spaces(int k) const { return same(stripped(k), total(k)); }
bool Study::full_rank(int k) const { return left(k) == 0 && dimension(total(k)) == 0; }
bool Study::rank_deficient(int k) const { return left(k) > 0 && dimension(total(k)) > 0; }

bool Study::stripped_spanned_by(int k, const Vectors& vectors) const {
  return are_basis(stripped(k), courses_, vectors);
}
bool Study::along_spanned_by(const Vectors& vectors) const { return are_basis(along(), courses_, vectors); }
bool Study::along_contains(const Vectors& vectors) const { return contain(along(), courses_, vectors); }

std::string Study::segments_text() const {
  const std::string som = joined(dimensions()), tom = joined(total_dimensions());
  return tom == som ? som : fmt::format("{} (TOM {})", som, tom);
}

std::string Study::text() const {
  std::vector<int> counts;
  for (int k = 1; k <= which_.segments; ++k) counts.push_back(k);
  return fmt::format("SOM and TOM leave {} dimensions after {} segments, the motion itself {}",
                     segments_text(), joined(counts), joined({true_dimension()}));
}

std::string Study::numbers() const {
  return fmt::format("{} and {}", segments_text(), joined({true_dimension()}));
}

Studies::Studies(const std::string& what)
    : head_(what.empty() ? legend : std::string(legend) + ", " + what) {}

const Study& Studies::add(const std::string& name, const Study& one) {
  lines_.push_back(name + " " + one.numbers());
  all_.emplace_back(one);
  return one;
}

std::string Studies::text() const { return fmt::format("{}: {}", head_, fmt::join(lines_, "; ")); }

bool Studies::all(const std::function<bool(const Study&)>& hold) const {
  return std::ranges::all_of(all_, hold);
}

std::vector<int> Studies::each(const std::function<int(const Study&)>& of) const {
  std::vector<int> numbers;
  for (const Study& s : all_) numbers.push_back(of(s));
  return numbers;
}

Studies by_features(std::initializer_list<int> numbers, Case which) {
  return by_number_of("features", &Case::features, numbers, std::move(which));
}

Studies by_anchors(std::initializer_list<int> numbers, Case which) {
  return by_number_of("anchors", &Case::anchors, numbers, std::move(which));
}

std::vector<int> each_of(std::initializer_list<int> numbers, const std::function<int(int)>& of) {
  std::vector<int> all;
  for (const int n : numbers) all.push_back(of(n));
  return all;
}

const Study& study(const Case& which) {
  static std::map<std::string, std::unique_ptr<Study>> known;
  std::unique_ptr<Study>& one = known[key_of(which)];
  if (!one) one = std::make_unique<Study>(which);
  return *one;
}

Spaces lie(const Case& which, int how_many) {
  const Instance made(which);
  Spaces spaces;
  for (int seed = 1; seed <= how_many; ++seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), stream);
    const SystemMotion motion = draw_motion(made.numbers, which.segments, random);
    const LieAnalysis analysis = analyze_lie(made.numbers, motion, random);
    if (!analysis.closed)
      throw std::runtime_error(which.system + ": Lie derivatives of higher orders may have a higher rank");
    spaces.push_back(analysis.space);
  }
  return spaces;
}

int dimension(const Spaces& spaces) {
  if (spaces.empty()) return no_dimension;
  const auto agrees = [&](const NullSpace& s) { return !s.ambiguous && s.nullity == spaces[0].nullity; };
  return std::ranges::all_of(spaces, agrees) ? spaces[0].nullity : no_dimension;
}

Spaces null_spaces(const Study& study, const std::function<MatrixXd(const Course&)>& matrix) {
  Spaces spaces;
  for (const Course& course : study.courses()) spaces.push_back(null_space(NoisyRows::exact(matrix(course))));
  return spaces;
}

std::string joined(const std::vector<int>& dimensions) {
  std::string text;
  for (const int d : dimensions)
    text += (text.empty() ? "" : "/") + (d == no_dimension ? "not the same in all" : std::to_string(d));
  return text;
}

bool contain(const Spaces& spaces, const std::vector<Course>& courses, const Vectors& vectors) {
  for (std::size_t i = 0; i < spaces.size(); ++i)
    for (const VectorXd& v : vectors(courses[i]))
      if (!spaces[i].contains(v)) return false;
  return !spaces.empty();
}

bool are_basis(const Spaces& spaces, const std::vector<Course>& courses, const Vectors& vectors) {
  if (!contain(spaces, courses, vectors)) return false;
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    const MatrixXd V = normalized(vectors(courses[i]), spaces[i].column_scale);
    if (rank_of(V) != V.cols() || V.cols() != spaces[i].nullity) return false;
  }
  return true;
}

int span(const std::vector<Course>& courses, const Vectors& vectors) {
  std::vector<Eigen::Index> ranks;
  for (const Course& course : courses) {
    const auto all = vectors(course);
    if (all.empty()) return no_dimension;
    ranks.push_back(rank_of(normalized(all, VectorXd::Ones(all[0].size()))));
  }
  return agreed(ranks);
}

int dimension_within(const Spaces& spaces, Eigen::Index first, Eigen::Index count) {
  std::vector<Eigen::Index> ranks;
  for (const NullSpace& space : spaces)
    ranks.push_back(space.nullity == 0 ? 0 : rank_of(space.scaled_null.middleRows(first, count)));
  return agreed(ranks);
}

bool same(const Spaces& a, const Spaces& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].nullity != b[i].nullity) return false;
    for (Eigen::Index j = 0; j < a[i].basis.cols(); ++j)
      if (!b[i].contains(a[i].basis.col(j))) return false;
  }
  return true;
}

std::optional<ClaimNumber> number_of(std::string what, int dimension) {
  if (dimension == no_dimension) return std::nullopt;
  return exactly(std::move(what), dimension);
}

std::optional<ClaimNumber> left_in_truth(const Study& study, const std::string& added) {
  return number_of("dimensions left by the motion itself" + added, study.true_dimension());
}

bool seen_by_frozen_rows_only(const Study& study, const Vectors& vectors) {
  const Spaces by_H = null_spaces(study, [](const Course&c) { return c.exact[0].H; }),
               by_HF =
                   null_spaces(study, [](const Course&c) -> MatrixXd { return c.exact[0].H * c.exact[0].F; });
  const auto outside = [&](std::size_t i) {
    return std::ranges::none_of(vectors(study.courses()[i]),
                                [&](const VectorXd& v) { return by_HF[i].contains(v); });
  };
  bool frozen = contain(by_H, study.courses(), vectors) && study.along_contains(vectors);
  for (std::size_t i = 0; i < by_HF.size(); ++i) frozen = frozen && outside(i);
  return frozen;
}

std::vector<std::string> observable_states(const Spaces& spaces, const std::vector<std::string>& states) {
  std::vector<std::string> seen;
  for (std::size_t state = 0; state < states.size(); ++state) {
    const auto sees = [&](const NullSpace& space) { return !touched(space.basis)[state]; };
    const auto count = std::ranges::count_if(spaces, sees);
    if (count > 0) seen.push_back(states[state] + (count < static_cast<long>(spaces.size()) ? "?" : ""));
  }
  return seen;
}

Spaces stripped_with(const Study& study, int k,
                     const std::function<void(LinearizedSystem&, const SystemPoint&)>& change) {
  Spaces spaces;
  for (const Course& course : study.courses()) {
    std::vector<LinearizedSystem> forms = course.forms;
    for (std::size_t j = 0; j < forms.size(); ++j) change(forms[j], course.points[j]);
    const auto upto = stripped_observability(segment_observability(forms));
    spaces.push_back(null_space(upto[static_cast<std::size_t>(k - 1)]));
  }
  return spaces;
}

double largest(const Study& study, const std::function<double(const Course&)>& of) {
  double value = 0;
  for (const Course& course : study.courses()) value = std::max(value, of(course));
  return value;
}

std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) return "none";
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace incognita::observability_claims
