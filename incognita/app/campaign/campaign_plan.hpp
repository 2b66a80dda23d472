// Which runs a campaign is made of: variants of a scenario, each with the same seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

/// What was asked for, as it was written.
struct CampaignRequest {
  std::string scenario = "room";
  std::string seeds = "1..10";        ///< "1..100", "3", "1,5,10..20"
  std::vector<std::string> sets;      ///< "key=value", of every variant
  std::vector<std::string> vary;      ///< "key=value,value"
  std::vector<std::string> baseline;  ///< "key=value"; keys that are not named take their first value
  std::optional<std::string> duration_s;
};

struct Variant {
  std::string name;  ///< "decision.strategy=none decision.step_m=0.2"; the scenario's where nothing varies
  std::vector<Flag> flags;                    ///< what makes it, the duration included
  std::map<std::string, std::string> varied;  ///< key and value in TOML
  /// What its runs depend on beside the seed: every setting in force, in TOML, less those that follow others.
  std::map<std::string, std::string> settings;
  std::map<std::string, std::string> files;  ///< digests of small files that settings name, by key
};

struct CampaignPlan {
  std::string scenario;       ///< as asked for
  std::string scenario_name;  ///< the file's name without ".toml"
  std::vector<std::string> sets;
  std::vector<std::int64_t> seeds;  ///< rising, each once
  std::vector<Variant> variants;    ///< the first --vary changes slowest
  std::size_t baseline = 0;

  std::size_t runs() const { return seeds.size() * variants.size(); }
  /// Run r: every variant on the first seed, then every one on the second.
  const Variant& variant_of(std::size_t run) const { return variants[run % variants.size()]; }
  std::int64_t seed_of(std::size_t run) const { return seeds[run / variants.size()]; }
};

/// Loads every variant. Throws InputError with what is wrong and what would be right.
CampaignPlan plan_campaign(const CampaignRequest& request);

/// The scenario of one run.
LoadedScenario load_run(const CampaignPlan& plan, const Variant& variant, std::int64_t seed);

/// Of all that its runs depend on, in their order.
std::string digest_of(const CampaignPlan& plan);

/// "1..3,7" as 1 2 3 7. Throws InputError unless rising ranges of whole numbers, none twice.
std::vector<std::int64_t> parse_seeds(const std::string& text);

/// At commas, but not at those inside brackets or quotes: `[1, 2],[3, 4]` are two.
/// Throws InputError on an empty value and on brackets or quotes that do not close.
std::vector<std::string> split_values(const std::string& text);

/// 16 hexadecimal digits that tell one text from another.
std::string digest_of(const std::string& text);

}  // namespace incognita
