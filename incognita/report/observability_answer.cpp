#include "incognita/report/observability_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

std::string gap_text(const NullSpace& space) {
  return space.nullity == 0      ? "full rank"
         : std::isinf(space.gap) ? "exact"
                                 : fmt::format("{:.0e}", space.gap);
}

std::string row(const std::string& method, const NullSpace& space, const std::string& note) {
  return fmt::format("  {:<30}{:>5}{:>9}{:>9.0e}{:>11}   {}{}\n", method, space.rank, space.nullity,
                     space.least, gap_text(space), space.ambiguous ? "ambiguous" : "",
                     space.ambiguous && !note.empty() ? "; " + note : note);
}

std::string rows_of(const ObservabilityAnalysis& a) {
  std::string text =
      fmt::format("  {:<30}{:>5}{:>9}{:>9}{:>11}\n", "method", "rank", "nullity", "least", "gap");
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    const SegmentAnalysis& s = a.segments[k];
    const std::string upto = k == 0 ? "segment 1" : fmt::format("segments 1 to {}", k + 1);
    text += row("SOM, " + upto, s.stripped.space, s.condition_holds ? "(4.9) holds" : "(4.9) does not hold");
    text += row("TOM, " + upto, s.total.space, "");
  }
  text += row("along the motion", a.local.space, "");
  text += row("Fisher information", a.fisher.space, "");
  if (!a.lie) return text;
  const std::string order = fmt::format("order {}{}{}", a.lie->order,
                                        a.lie->closed   ? ", complete"
                                        : a.lie->missed ? ", possibly incomplete"
                                                        : ", limit reached",
                                        a.lie->inputs_nonlinear ? "; at drawn inputs" : "");
  return text + row("Lie derivatives", a.lie->space, order);
}

std::string vectors_of(const std::string& what, const std::vector<UnobservableDirection>& directions,
                       const std::vector<std::string>& states, bool barely = false) {
  if (directions.empty())
    return what + (barely ? ": none; but see the note on weakly observable states\n" : ": none\n");
  std::string text = what + ":\n";
  for (const UnobservableDirection& d : directions) {
    const std::string written = written_combination(d.vector, states);
    if (d.name == written)
      text += fmt::format("  {}\n", d.name);
    else if (d.name.size() <= 28)
      text += fmt::format("  {:<28} {}\n", d.name, written);
    else
      text += fmt::format("  {}:\n  {:<28} {}\n", d.name, "", written);
  }
  return text;
}

std::string observable_states(const ObservabilityAnalysis& a) {
  std::string seen, unseen;
  for (const StateInformation& state : a.information) {
    std::string& list = state.sigma ? seen : unseen;
    list += (list.empty() ? "" : ", ") + state.state;
    if (state.sigma) list += fmt::format(" ({:.2g})", *state.sigma);
  }
  return fmt::format(
      "Observable states, with their minimum sigma for this motion{}: {}\nNot observable by themselves: {}\n",
      a.sigmas_trusted || seen.empty() ? "" : " (unreliable: see the notes)", seen.empty() ? "none" : seen,
      unseen.empty() ? "none" : unseen);
}

std::string counted(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string values_of(const std::vector<std::string>& names, const Eigen::VectorXd& values) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}{} = {:.4g}", text.empty() ? "" : ", ", names[i], values[Eigen::Index(i)]);
  return text;
}

/// State and inputs at the start of the first segment, if the text is short.
std::string start_of(const ObservabilityAnalysis& a) {
  const std::string inputs = values_of(a.inputs, a.points.front().u);
  const std::string start =
      values_of(a.states, a.points.front().x) + (inputs.empty() ? "" : ", with " + inputs);
  constexpr std::size_t longest = 100;
  const bool is_short = start.size() <= longest;
  return fmt::format("{}{} measurement times in total; --json has {}.\n",
                     is_short ? "Segment 1 is at " + start + ". " : "", a.measurement_times_s.size(),
                     is_short
                         ? "all digits, the other segments, the anchors and the measurement times"
                         : "the starts and inputs of the segments, the anchors and the measurement times");
}

}  // namespace

std::string observability_table(const SystemText& text, const ObservabilityAnalysis& a,
                                const ObservabilitySettings& settings) {
  const std::string source = text.source.empty() ? "" : text.source + "\n";
  std::string out =
      fmt::format("{}: {}\n{}{} representation, {}, {}, {} motion, {} states, seed {}\n\n", text.name,
                  text.title, source, a.representation, counted(a.landmarks, "feature", "features"),
                  counted(a.anchors, "anchor", "anchors"), a.motion, a.states.size(), settings.seed);
  out.insert(out.size() - 1, start_of(a));
  out += rows_of(a);
  out += fmt::format(
      "\nRank: number of singular values above {:.0e} of the largest, after scaling rows and columns to unit length.\n"
      "Least: the smallest of these over the largest. Gap: the smallest of these over the next one. A rank is ambiguous with a gap\nbelow {:.0e}, values close to the tolerance, or effects below rounding.\n\n",
      settings.rank.tolerance, settings.rank.clear_gap);
  const std::size_t segments = a.segments.size();
  out +=
      vectors_of(fmt::format("Unobservable by SOM, after {}", counted(int(segments), "segment", "segments")),
                 a.segments.back().stripped.directions, a.error_states);
  const bool barely = std::any_of(a.information.begin(), a.information.end(),
                                  [](const StateInformation& i) { return i.weakly_observable; });
  out += "\n" + vectors_of("Unobservable along the motion", a.local.directions, a.states, barely) + "\n";
  // Where the ranks differ, the observable states would otherwise seem to contradict the directions above.
  if (a.fisher.space.nullity != a.local.space.nullity)
    out += vectors_of("Unobservable by the Fisher information", a.fisher.directions, a.states) + "\n";
  if (a.lie && a.lie->space.nullity != a.local.space.nullity)
    out += vectors_of("Unobservable by the Lie derivatives", a.lie_directions, a.states) + "\n";
  out += observable_states(a);
  for (const std::string& line : a.disagreements) out += "\nThe methods disagree. " + line + "\n";
  for (const auto* lines : {&a.doubts, &a.notes})
    for (const std::string& line : *lines) out += "\nNote. " + line + "\n";
  return out;
}

namespace {

Json numbers(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

Json gap_json(const NullSpace& space) { return std::isinf(space.gap) ? Json() : Json(space.gap); }

Json directions_json(const std::vector<UnobservableDirection>& directions) {
  Json all = Json::array();
  for (const auto& d : directions) all.push_back({{"name", d.name}, {"vector", numbers(d.vector)}});
  return all;
}

Json by_name(const std::vector<std::string>& names, const Eigen::VectorXd& values) {
  Json all = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i) all[names[i]] = values[Eigen::Index(i)];
  return all;
}

Json anchors_json(const ObservabilityAnalysis& a) {
  Json all = Json::array();
  const auto size = static_cast<Eigen::Index>(a.constants.size());
  for (int i = 0; i < a.anchors; ++i)
    all.push_back(by_name(a.constants, a.points.front().anchors.segment(i * size, size)));
  return all;
}

Json segment_json(const ObservabilityAnalysis& a, std::size_t k) {
  const SegmentAnalysis& s = a.segments[k];
  Json vectors = Json::array();
  for (const Eigen::VectorXd& v : readable_basis(s.stripped.space)) vectors.push_back(numbers(v));
  return {{"start", by_name(a.states, a.points[k].x)},
          {"inputs", by_name(a.inputs, a.points[k].u)},
          {"duration_s", a.durations_s[k]},
          {"som_nullity", s.stripped.space.nullity},
          {"tom_nullity", s.total.space.nullity},
          {"condition_holds", s.condition_holds},
          {"nullspace", vectors},
          {"directions", directions_json(s.stripped.directions)},
          {"som_gap", gap_json(s.stripped.space)},
          {"som_least", s.stripped.space.least},
          {"tom_gap", gap_json(s.total.space)},
          {"tom_least", s.total.space.least}};
}

Json lie_rows(const LieAnalysis& lie) {
  Json rows = Json::array();
  for (const LieRow& r : lie.rows) {
    if (!r.raised_rank) continue;
    Json parts = Json::array();
    for (const auto& [name, expression] : r.definitions)
      parts.push_back({{"name", name}, {"expression", expression}});
    rows.push_back({{"name", r.name},
                    {"owner", r.owner},
                    {"order", r.order},
                    {"expression", r.expression},
                    {"where", parts}});
  }
  return rows;
}

}  // namespace

std::string observability_json(const ObservabilityAnalysis& a, const ObservabilitySettings& settings) {
  Json json{{"system", a.system},
            {"representation", a.representation},
            {"motion", a.motion},
            {"features", a.landmarks},
            {"anchors", a.anchors},
            {"seed", settings.seed},
            {"states", a.states},
            {"error_states", a.error_states},
            {"anchors_at", anchors_json(a)},
            {"measurements_per_segment", a.measurements_per_segment},
            {"measurement_times_s", a.measurement_times_s},
            {"segments", Json::array()},
            {"local_nullity", a.local.space.nullity},
            {"local_gap", gap_json(a.local.space)},
            {"local_least", a.local.space.least},
            {"fisher_nullity", a.fisher.space.nullity},
            {"fisher_gap", gap_json(a.fisher.space)},
            {"fisher_least", a.fisher.space.least},
            {"lie_nullity", a.lie ? Json(a.lie->space.nullity) : Json()},
            {"lie_order", a.lie ? Json(a.lie->order) : Json()},
            {"lie_closed", a.lie ? Json(a.lie->closed) : Json()},
            {"lie_gap", a.lie ? gap_json(a.lie->space) : Json()},
            {"lie_least", a.lie ? Json(a.lie->space.least) : Json()},
            {"lie_rows", a.lie ? lie_rows(*a.lie) : Json::array()},
            {"directions", directions_json(a.local.directions)},
            {"information", Json::array()},
            {"sigmas_trusted", a.sigmas_trusted},
            {"tolerance", settings.rank.tolerance},
            {"disagreements", a.disagreements},
            {"doubts", a.doubts},
            {"notes", a.notes}};
  for (std::size_t k = 0; k < a.segments.size(); ++k) json["segments"].push_back(segment_json(a, k));
  for (const StateInformation& i : a.information)
    json["information"].push_back({{"state", i.state}, {"sigma", i.sigma ? Json(*i.sigma) : Json()}});
  return json.dump(2) + "\n";
}

}  // namespace incognita
