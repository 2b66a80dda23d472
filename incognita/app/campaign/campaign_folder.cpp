#include "incognita/app/campaign/campaign_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/durable_file.hpp"
#include "incognita/record/files/folders.hpp"
#include "incognita/record/files/row_file.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_result = 16 << 20;
constexpr std::size_t most_differences = 5;

Json identity_of(const CampaignPlan& plan, const Variant& variant, const std::string& version) {
  return {{"scenario", plan.scenario_name}, {"version", version},           {"variant", variant.name},
          {"varied", variant.varied},       {"settings", variant.settings}, {"files", variant.files}};
}

/// A readable and unique folder name: the variant's name in portable characters, and a digest.
std::string folder_name(const std::string& variant) {
  constexpr std::size_t longest = 80;
  std::string name = variant.substr(0, longest);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) &&
        std::string_view("._=-").find(c) == std::string_view::npos)
      c = '_';
  return name + "-" + digest_of(variant).substr(0, 8);
}

fs::path variant_folder(const fs::path& campaign, const Variant& variant) {
  return campaign / "runs" / folder_name(variant.name);
}

fs::path result_file(const fs::path& campaign, const CampaignPlan& plan, std::size_t run) {
  return run_directory(campaign, plan, run).string() + ".json";
}

/// The JSON object in the file; null if there is none.
Json read_json(const fs::path& file) {
  if (!file_exists(file)) return nullptr;
  try {
    const Json json = Json::parse(read_file(file, largest_result), nullptr, false);
    return json.is_object() ? json : Json(nullptr);
  } catch (const InputError&) {
    return nullptr;
  }
}

std::string text_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

/// E.g. "run.duration_s = 20.0 there, 60.0 here", for settings of both that neither varies.
std::vector<std::string> differences(const Json& there, const Json& here) {
  std::vector<std::string> found;
  for (const char* key : {"scenario", "version"})
    if (text_of(there, key) != text_of(here, key))
      found.push_back(fmt::format("{} {} there, {} here", key, text_of(there, key), text_of(here, key)));
  const auto empty = Json::object();
  for (const char* part : {"settings", "files"}) {
    const Json& old = there.contains(part) && there[part].is_object() ? there[part] : empty;
    for (const auto& [key, value] : here[part].items()) {
      const bool varies =
          (there.contains("varied") && there["varied"].contains(key)) || here["varied"].contains(key);
      if (varies || !old.contains(key) || old[key] == value) continue;
      const auto plain = [](const Json& j) { return j.is_string() ? j.get<std::string>() : j.dump(); };
      found.push_back(std::string(part) == "files"
                          ? fmt::format("the content of the file in {}", key)
                          : fmt::format("{} = {} there, {} here", key, plain(old[key]), plain(value)));
    }
  }
  if (found.empty() && text_of(there, "variant") == text_of(here, "variant") && there != here)
    found.push_back("which settings apply");
  return found;
}

}  // namespace

fs::path run_directory(const fs::path& campaign, const CampaignPlan& plan, std::size_t run) {
  return variant_folder(campaign, plan.variant_of(run)) / fmt::format("seed-{}", plan.seed_of(run));
}

CampaignFolder::CampaignFolder(fs::path path, const CampaignPlan& plan, const std::string& version)
    : path_(std::move(path)), plan_(plan) {
  for (const Variant& variant : plan.variants)
    identities_.push_back(identity_of(plan, variant, version).dump(1) + "\n");
  refuse_others();
  try {
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
      const fs::path folder = variant_folder(path_, plan.variants[v]), file = folder / "settings.json";
      for (fs::path& missing : missing_folders(folder)) made_.push_back(std::move(missing));
      std::error_code error;
      fs::create_directories(folder, error);
      if (error) throw RecordError(write_failure(folder, error.value()));
      if (::access(folder.c_str(), W_OK) != 0) throw RecordError(write_failure(folder, errno));
      if (!file_exists(file) || read_file(file, largest_result) != identities_[v])
        write_durably(file, identities_[v]);
    }
  } catch (const RecordError& error) {
    throw InputError(fmt::format("--out {}: {}", path_.string(), error.what()));
  }
}

void CampaignFolder::refuse_others() const {
  std::error_code ignored;
  for (fs::directory_iterator it(path_ / "runs", ignored), end; !ignored && it != end;
       it.increment(ignored)) {
    const Json there = read_json(it->path() / "settings.json");
    if (!there.is_object()) continue;
    for (const std::string& identity : identities_) {
      std::vector<std::string> found = differences(there, Json::parse(identity));
      if (found.empty()) continue;
      if (found.size() > most_differences) {
        const std::size_t more = found.size() - most_differences;
        found.resize(most_differences);
        found.push_back(fmt::format("and {} more", more));
      }
      throw InputError(fmt::format(
          "--out {}: it contains runs of another campaign ({}): {}. Choose another folder with --out, or give the same settings to continue",
          path_.string(), text_of(there, "variant"), fmt::join(found, "; ")));
    }
  }
}

bool CampaignFolder::has(std::size_t run) const { return read(run).has_value(); }

std::optional<RunResult> CampaignFolder::read(std::size_t run) const {
  const Json json = read_json(result_file(path_, plan_, run));
  if (!json.is_object()) return std::nullopt;
  const std::string& identity = identities_[run % plan_.variants.size()];
  if (text_of(json, "settings") != digest_of(identity) || json.value("seed", Json()) != plan_.seed_of(run))
    return std::nullopt;
  RunResult result{text_of(json, "status"), text_of(json, "reason"), 0, "", text_of(json, "program")};
  if (result.status != "done" && result.status != "failed") return std::nullopt;
  if (json.contains("seconds") && json["seconds"].is_number()) result.seconds = json["seconds"].get<double>();
  const bool whole = json.contains("summary") && json["summary"].is_object();
  if (result.status == "done" && !whole) return std::nullopt;
  if (whole) result.summary_json = json["summary"].dump();
  return result;
}

void CampaignFolder::write(std::size_t run, const RunResult& result) const {
  const Json summary = result.summary_json.empty() ? Json(nullptr) : Json::parse(result.summary_json);
  const Json json = {{"variant", plan_.variant_of(run).name},
                     {"seed", plan_.seed_of(run)},
                     {"status", result.status},
                     {"reason", result.reason},
                     {"seconds", result.seconds},
                     {"settings", digest_of(identities_[run % plan_.variants.size()])},
                     {"program", result.program},
                     {"summary", summary}};
  write_durably(result_file(path_, plan_, run),
                json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void CampaignFolder::discard_what_is_empty() const {
  std::error_code ignored;
  for (const Variant& variant : plan_.variants) {
    const fs::path folder = variant_folder(path_, variant);
    const bool made = std::find(made_.begin(), made_.end(), folder) != made_.end();
    const auto files = std::distance(fs::directory_iterator(folder, ignored), fs::directory_iterator());
    if (made && files == 1) fs::remove(folder / "settings.json", ignored);
  }
  remove_empty(made_);
}

void CampaignFolder::tidy() const {
  remove_partial_files(path_);
  for (const Variant& variant : plan_.variants) remove_partial_files(variant_folder(path_, variant));
}

}  // namespace incognita
