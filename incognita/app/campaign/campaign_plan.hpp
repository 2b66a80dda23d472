// The runs of a campaign: variants of a scenario, each run with the same seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

/// The command-line request, unparsed.
struct CampaignRequest {
  std::string scenario = "room";
  std::string seeds = "1..10";    ///< "1..100", "3", "1,5,10..20"
  std::vector<std::string> sets;  ///< "key=value", for all variants
  std::vector<std::string> vary;  ///< "key=value,value"
  std::vector<std::string>
      variants;  ///< "key=value key=value", each compared with the scenario as it is; not beside `vary`
  std::vector<std::string> baseline;  ///< "key=value"; keys not named take their first value
  std::optional<std::string> duration_s;
};

struct Variant {
  std::string
      name;  ///< "decision.strategy=none decision.step_m=0.2"; the scenario's name if nothing is changed
  std::vector<Flag> flags;                    ///< what defines it, including the duration
  std::map<std::string, std::string> varied;  ///< key and value in TOML of what defines it
  /// Everything its runs depend on except the seed: all settings in force, in TOML, except those derived from others.
  std::map<std::string, std::string> settings;
  std::map<std::string, std::string> files;  ///< digests of small files that settings name, by key
};

struct CampaignPlan {
  std::string scenario;       ///< as requested
  std::string scenario_name;  ///< the file's name without ".toml"
  std::vector<std::string> sets;
  std::vector<std::int64_t> seeds;  ///< increasing, without duplicates
  std::vector<Variant> variants;    ///< the first --vary changes slowest
  std::size_t baseline = 0;

  std::size_t runs() const { return seeds.size() * variants.size(); }
  /// Run index: every variant on the first seed, then every variant on the second, and so on.
  const Variant& variant_of(std::size_t run) const { return variants[run % variants.size()]; }
  std::int64_t seed_of(std::size_t run) const { return seeds[run / variants.size()]; }
};

/// Loads every variant. Throws InputError with the problem and its remedy.
CampaignPlan plan_campaign(const CampaignRequest& request);

/// Loads the scenario of one run.
LoadedScenario load_run(const CampaignPlan& plan, const Variant& variant, std::int64_t seed);

/// Digest of everything the runs depend on, and of their order.
std::string digest_of(const CampaignPlan& plan);

/// Parses "1..3,7" as 1 2 3 7. Throws InputError unless given as increasing ranges of integers without duplicates.
std::vector<std::int64_t> parse_seeds(const std::string& text);

/// Splits at commas outside brackets and quotes: `[1, 2],[3, 4]` are two values. Throws InputError for an
/// empty value and for unbalanced brackets or quotes.
std::vector<std::string> split_values(const std::string& text);

/// A digest of 16 hexadecimal digits.
std::string digest_of(const std::string& text);

}  // namespace incognita
