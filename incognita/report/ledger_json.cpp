// The ledger as JSON, and back.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "incognita/messages/errors.hpp"
#include "incognita/report/ledger.hpp"

namespace incognita {
namespace {

using LedgerJson = nlohmann::ordered_json;

constexpr std::array findings{Finding::holds, Finding::misprint, Finding::holds_if, Finding::does_not_hold,
                              Finding::undecided};

/// JSON has no infinity; an end that is not known is left out.
LedgerJson json_of(const ClaimNumber& number) {
  LedgerJson json{{"what", number.what}};
  if (std::isfinite(number.value.value)) json["value"] = number.value.value;
  if (std::isfinite(number.value.low)) json["low"] = number.value.low;
  if (std::isfinite(number.value.high)) json["high"] = number.value.high;
  json["unit"] = number.unit;
  return json;
}

LedgerJson json_of(const Claim& claim) {
  LedgerJson json{{"id", claim.id}, {"origin", claim.source ? "thesis" : "own"}, {"place", claim.place}};
  if (claim.source) {
    json["section"] = claim.source->section;
    json["pages"] = claim.source->pages;
    json["quotation"] = claim.source->quotation;
  }
  json["statement"] = claim.statement;
  json["printed"] = claim.printed;
  json["measured"] = claim.measured;
  if (claim.number) json["number"] = json_of(*claim.number);
  json["rule"] = name(claim.rule);
  json["finding"] = name(claim.finding);
  if (claim.by_method) json["by_method"] = name(*claim.by_method);
  json["verdict"] = verdict(claim.finding);
  json["why"] = claim.why;
  if (!claim.headline.empty()) json["headline"] = claim.headline;
  json["runs"] = claim.runs;
  json["least_runs"] = claim.least_runs;
  if (claim.timed) json["timed"] = true;
  return json;
}

LedgerJson json_of(const LedgerEntry& entry) {
  LedgerJson json{{"id", entry.id}, {"title", entry.title}};
  if (!entry.skipped.empty()) json["skipped"] = entry.skipped;
  json["claims"] = LedgerJson::array();
  for (const Claim& claim : entry.claims) json["claims"].push_back(json_of(claim));
  json["figures"] = LedgerJson::array();
  for (const LedgerFigure& figure : entry.figures)
    json["figures"].push_back({{"id", figure.id}, {"file", figure.file}, {"data", figure.data}});
  return json;
}

/// The value of that name. Throws std::invalid_argument, as the caller adds the place.
template <class Value>
Value named_as(const std::string& word, const auto& values) {
  for (const Value value : values)
    if (word == name(value)) return value;
  throw std::invalid_argument("unknown word `" + word + "`");
}

ClaimNumber number_from(const LedgerJson& json) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {json.at("what"),
          {json.value("value", std::nan("")), json.value("low", -inf), json.value("high", inf)},
          json.at("unit")};
}

Claim claim_from(const LedgerJson& json) {
  Claim claim{.id = json.at("id"),
              .place = json.at("place"),
              .statement = json.at("statement"),
              .printed = json.at("printed"),
              .measured = json.at("measured"),
              .finding = named_as<Finding>(json.at("finding"), findings),
              .why = json.at("why"),
              .runs = json.at("runs"),
              .least_runs = json.at("least_runs"),
              .timed = json.value("timed", false),
              .rule = named_as<Rule>(json.at("rule"), all_rules())};
  if (json.contains("number")) claim.number = number_from(json["number"]);
  if (json.at("origin") == "thesis")
    claim.source = ClaimSource{json.at("section"), json.at("pages"), json.at("quotation")};
  if (json.contains("by_method")) claim.by_method = named_as<Finding>(json["by_method"], findings);
  claim.headline = json.value("headline", "");
  return claim;
}

LedgerEntry entry_from(const LedgerJson& json) {
  LedgerEntry entry{json.at("id"), json.at("title"), json.value("skipped", ""), {}, {}};
  for (const LedgerJson& claim : json.at("claims")) entry.claims.push_back(claim_from(claim));
  for (const LedgerJson& f : json.at("figures"))
    entry.figures.push_back({f.at("id"), f.at("file"), f.at("data")});
  return entry;
}

}  // namespace

std::string ledger_json(const std::vector<LedgerEntry>& entries) {
  LedgerJson document = LedgerJson::array();
  for (const LedgerEntry& entry : entries) document.push_back(json_of(entry));
  // Reasons may contain file names that are not UTF-8; a replaced character is better than an exception.
  return document.dump(1, ' ', false, LedgerJson::error_handler_t::replace) + "\n";
}

std::vector<LedgerEntry> read_ledger(const std::string& document, const std::string& name) {
  try {
    const LedgerJson json = LedgerJson::parse(document);
    if (!json.is_array()) throw std::invalid_argument("it is no list of entries");
    std::vector<LedgerEntry> entries;
    for (const LedgerJson& entry : json) entries.push_back(entry_from(entry));
    return entries;
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: is not what `incognita reproduce` writes as claims.json: {}", name, error.what()));
  }
}

}  // namespace incognita
