#include "incognita/app/campaign/campaign_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <charconv>
#include <set>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/scenario/scenario_file.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_runs = 1'000'000;
constexpr std::size_t largest_named_file = 64 << 20;
constexpr std::string_view seeds_form = "written as 1..100 or 1,5,10..20";

/// A parsed --vary.
struct Varied {
  std::string key;
  std::vector<std::string> values;
};

/// The settings that define a variant, as they were written.
using Assignments = std::vector<std::pair<std::string, std::string>>;

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

std::int64_t seed_of_text(const std::string& text, const std::string& all) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0 || text.empty())
    throw InputError(fmt::format("--seeds {}: `{}` is not a seed; seeds are whole numbers from 0, {}", all,
                                 text, seeds_form));
  return value;
}

/// Splits at a character outside brackets and quotes; the parts are trimmed. Throws InputError where those do not close.
std::vector<std::string> parts_of(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (c == at && depth == 0 && !quote) {
      parts.emplace_back();
      continue;
    }
    if (quote)
      quote = c == quote ? 0 : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else
      depth += (c == '[') - (c == ']');
    parts.back() += c;
    if (depth < 0) break;
  }
  if (depth != 0 || quote) throw InputError("brackets or quotes do not close");
  for (std::string& part : parts) part = trimmed(part);
  return parts;
}

/// Splits `key=value,value` of an option. `form`: how it must be written.
Varied take_apart(const std::string& option, const std::string& text, std::string_view form) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(fmt::format("{} {}: must be written {}", option, text, form));
  try {
    return {text.substr(0, equals), split_values(text.substr(equals + 1))};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} {}: {}", option, text, error.what()));
  }
}

/// The settings of one --variant. Blanks separate them, so a value with blanks is written in quotes or brackets.
Assignments settings_of(const std::string& variant) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(fmt::format(
        "--variant {}: {}; it is written 'section.name=value section.name=value', a value with blanks in quotes, e.g. --variant 'decision.step_m=0.2 decision.period_s=1'",
        variant, problem));
  };
  std::vector<std::string> parts;
  try {
    parts = parts_of(variant, ' ');
  } catch (const InputError& error) {
    refuse(error.what());
  }
  std::erase(parts, "");  // several blanks separate like one
  if (parts.empty()) refuse("has no settings");
  Assignments settings;
  for (const std::string& part : parts) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size())
      refuse(fmt::format("`{}` is not a key and its value", part));
    const std::string key = part.substr(0, equals);
    if (std::ranges::find(settings, key, [](const auto& setting) { return setting.first; }) != settings.end())
      refuse("sets " + key + " twice");
    settings.emplace_back(key, part.substr(equals + 1));
  }
  return settings;
}

std::string key_of(const std::string& set) { return set.substr(0, set.find('=')); }

/// Refuses a key that is set in two ways, because one of them would be ignored.
void refuse_two_masters(const CampaignRequest& request, const std::vector<Assignments>& variants,
                        const std::string& option) {
  std::set<std::string> keys;
  for (const Assignments& variant : variants)
    for (const auto& [key, value] : variant) keys.insert(key);
  if (keys.contains("run.seed")) throw InputError(option + " run.seed: give the seeds with --seeds");
  if (keys.contains("run.duration_s") && request.duration_s)
    throw InputError(option + " run.duration_s and --duration set the same key; remove one of them");
  for (const std::string& set : request.sets) {
    if (key_of(set) == "run.seed") throw InputError("--set run.seed: give the seeds with --seeds");
    if (keys.contains(key_of(set)))
      throw InputError(
          fmt::format("--set {0} and {1} {0} set the same key; remove one of them", key_of(set), option));
  }
}

/// The text without quotes, as a user would type it.
std::string plain(const std::string& written) {
  const bool quoted =
      written.size() >= 2 && written.front() == '"' && written.find('\\') == std::string::npos;
  return quoted ? written.substr(1, written.size() - 2) : written;
}

/// `assigned`: what defines the variant.
void describe(Variant& variant, const LoadedScenario& loaded, const Assignments& assigned) {
  if (loaded.scenario.is_robot())
    throw InputError(
        loaded.source_of("world.type") +
        ": world.type = robot: a campaign repeats runs in a world of its own, and cannot do so with a robot");
  for (const SettingInForce& setting : loaded.settings) {
    const bool follows = setting.source.starts_with("as ");
    if (setting.key != "run.seed" && !follows) variant.settings[setting.key] = setting.value;
    if (!setting.names_file) continue;
    const auto file = std::get<std::string>(value_of_toml(setting.value).value);
    if (!file.empty())
      variant.files[setting.key] =
          digest_of(read_file(find_named_file(loaded, setting.key, file), largest_named_file));
  }
  for (const auto& [key, value] : assigned) {
    const std::string& in_force = variant.settings.at(key);
    variant.varied[key] = in_force;
    variant.name += (variant.name.empty() ? "" : " ") + key + "=" + plain(in_force);
  }
  if (assigned.empty()) variant.name = loaded.name;
}

std::vector<Varied> lists_of(const CampaignRequest& request) {
  constexpr std::string_view form = "section.name=value,value, e.g. --vary decision.step_m=0.2,0.3";
  std::vector<Varied> lists;
  for (const std::string& vary : request.vary) {
    Varied list = take_apart("--vary", vary, form);
    if (std::ranges::find(lists, list.key, &Varied::key) != lists.end())
      throw InputError(fmt::format("--vary {}: given twice; put all its values into one list", list.key));
    lists.push_back(std::move(list));
  }
  return lists;
}

/// All combinations; the first list changes slowest.
std::vector<Assignments> combinations(const std::vector<Varied>& lists, std::size_t most) {
  std::vector<Assignments> all(1);
  for (const Varied& list : lists) {
    if (all.size() * list.values.size() > most)
      throw InputError(fmt::format("campaign: more than {} runs; fewer --seeds or --vary values", most_runs));
    std::vector<Assignments> longer;
    for (const Assignments& one : all)
      for (const std::string& value : list.values) longer.emplace_back(one).emplace_back(list.key, value);
    all = std::move(longer);
  }
  return all;
}

/// The scenario as it is, then each variant.
std::vector<Assignments> with_the_scenario(const CampaignRequest& request, std::size_t most) {
  if (!request.vary.empty())
    throw InputError("--variant and --vary: a campaign has one of them; write the combinations as variants");
  if (!request.baseline.empty())
    throw InputError(
        "--baseline and --variant: variants are compared with the scenario as it is; remove --baseline");
  if (1 + request.variants.size() > most)
    throw InputError(fmt::format("campaign: more than {} runs; fewer --seeds or --variant", most_runs));
  std::vector<Assignments> all{{}};
  for (const std::string& variant : request.variants) all.push_back(settings_of(variant));
  return all;
}

void refuse_duplicates(const std::vector<Variant>& variants, const std::string& option) {
  std::map<std::pair<std::map<std::string, std::string>, std::map<std::string, std::string>>, std::string>
      names;
  for (const Variant& variant : variants) {
    const auto [same, is_new] = names.try_emplace({variant.settings, variant.files}, variant.name);
    if (!is_new)
      throw InputError(
          fmt::format("{}: the variant {} occurs twice: its settings are those of {}; remove one of them",
                      option, variant.name, same->second));
  }
}

/// The variant with the named values, and the first value of all other keys.
std::size_t find_baseline(const CampaignRequest& request, const CampaignPlan& plan,
                          const std::vector<Varied>& lists) {
  std::map<std::string, std::string> requested = plan.variants.front().varied;
  for (const std::string& assignment : request.baseline) {
    const Varied named = take_apart("--baseline", assignment, "section.name=value");
    const auto list =
        std::find_if(lists.begin(), lists.end(), [&](const Varied& l) { return l.key == named.key; });
    if (list == lists.end())
      throw InputError(
          fmt::format("--baseline {}: {} is not varied; the baseline is a combination of values of --vary",
                      assignment, named.key));
    const auto has_it = [&](const Variant& v) {
      const std::string& value = v.varied.at(named.key);
      return named.values.size() == 1 && (value == named.values[0] || plain(value) == plain(named.values[0]));
    };
    const auto found = std::find_if(plan.variants.begin(), plan.variants.end(), has_it);
    if (found == plan.variants.end())
      throw InputError(fmt::format("--baseline {}: is not one of the values of --vary {}: {}", assignment,
                                   named.key, fmt::join(list->values, ", ")));
    requested[named.key] = found->varied.at(named.key);
  }
  const auto found = std::find_if(plan.variants.begin(), plan.variants.end(),
                                  [&](const Variant& v) { return v.varied == requested; });
  return static_cast<std::size_t>(found - plan.variants.begin());
}

}  // namespace

std::string digest_of(const std::string& text) {
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~0ull, ~0ull, true, true> crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:016x}", static_cast<std::uint64_t>(crc.checksum()));
}

std::string digest_of(const CampaignPlan& plan) {
  std::string text = fmt::format("{}\n{}\n", INCOGNITA_VERSION, fmt::join(plan.seeds, " "));
  for (const Variant& variant : plan.variants)
    for (const auto* part : {&variant.settings, &variant.files})
      for (const auto& [key, value] : *part) text += fmt::format("{} = {}\n", key, value);
  return digest_of(text);
}

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values = parts_of(text, ',');
  if (std::ranges::find(values, "") != values.end())
    throw InputError("a value is missing; commas stand between values, except inside brackets and quotes");
  return values;
}

std::vector<std::int64_t> parse_seeds(const std::string& text) {
  std::vector<std::int64_t> seeds;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = trimmed(std::string_view(text).substr(begin, comma - begin));
    const std::size_t dots = part.find("..");
    const std::int64_t first = seed_of_text(part.substr(0, dots), text);
    const std::int64_t last = dots == std::string::npos ? first : seed_of_text(part.substr(dots + 2), text);
    if (last < first)
      throw InputError(fmt::format("--seeds {}: {} is decreasing, {}", text, part, seeds_form));
    if (static_cast<std::uint64_t>(last - first) >= most_runs || seeds.size() > most_runs)
      throw InputError(fmt::format("--seeds {}: more than {} runs", text, most_runs));
    for (std::int64_t seed = first;; ++seed) {
      seeds.push_back(seed);
      if (seed == last) break;
    }
    if (comma == text.size()) break;
    begin = comma + 1;
  }
  std::sort(seeds.begin(), seeds.end());
  const auto twice = std::adjacent_find(seeds.begin(), seeds.end());
  if (twice != seeds.end()) throw InputError(fmt::format("--seeds {}: {} occurs twice", text, *twice));
  return seeds;
}

LoadedScenario load_run(const CampaignPlan& plan, const Variant& variant, std::int64_t seed) {
  std::vector<Flag> flags = variant.flags;
  flags.push_back({"run.seed", std::to_string(seed), "--seeds"});
  return load_scenario(plan.scenario, plan.sets, flags);
}

CampaignPlan plan_campaign(const CampaignRequest& request) {
  const std::string option = request.variants.empty() ? "--vary" : "--variant";
  const std::vector<Varied> lists = lists_of(request);
  CampaignPlan plan;
  plan.scenario = request.scenario;
  plan.sets = request.sets;
  plan.seeds = parse_seeds(request.seeds);
  const std::size_t most = most_runs / plan.seeds.size();
  const std::vector<Assignments> all =
      request.variants.empty() ? combinations(lists, most) : with_the_scenario(request, most);
  refuse_two_masters(request, all, option);
  for (const Assignments& settings : all) {
    Variant& variant = plan.variants.emplace_back();
    for (const auto& [key, value] : settings) variant.flags.push_back({key, value, option});
    if (request.duration_s) variant.flags.push_back({"run.duration_s", *request.duration_s, "--duration"});
    const LoadedScenario loaded = load_run(plan, variant, plan.seeds.back());
    plan.scenario_name = loaded.name;
    describe(variant, loaded, settings);
  }
  refuse_duplicates(plan.variants, option);
  plan.baseline = find_baseline(request, plan, lists);
  return plan;
}

}  // namespace incognita
