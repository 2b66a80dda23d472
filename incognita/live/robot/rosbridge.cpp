#include "incognita/live/robot/rosbridge.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/json_limits.hpp"

namespace incognita::rosbridge {
namespace {

using Json = nlohmann::json;

constexpr int longest_ms = 3'600'000, longest_queue = 1000, most_fragments = 10000;
constexpr std::size_t longest_name = 256;

[[noreturn]] void refuse(const std::string& op, const std::string& why) {
  throw InputError(fmt::format("rosbridge: {}: {}", op, why));
}

/// The fields of one operation.
class Fields {
 public:
  Fields(const Json& json, std::string op) : json_(json), op_(std::move(op)) {}

  std::string text(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end() || !found->is_string())
      refuse(op_, fmt::format("field \"{}\" must be a text", key));
    return found->get<std::string>();
  }
  std::string name(const char* key) const {
    std::string name = text(key);
    if (name.empty() || name.size() > longest_name)
      refuse(op_, fmt::format("field \"{}\" must have 1 to {} characters, and has {}", key, longest_name,
                              name.size()));
    return name;
  }
  std::string name_or(const char* key, const char* otherwise) const {
    const auto found = json_.find(key);
    if (found == json_.end() || found->is_null() || *found == "") return otherwise;
    return name(key);
  }
  std::string id() const {
    const auto found = json_.find("id");
    if (found == json_.end() || found->is_null()) return "";
    if (found->is_number_integer()) return found->dump();
    return text("id").substr(0, longest_name);
  }
  int number(const char* key, int least, int most) const {
    const auto found = json_.find(key);
    const bool fits = found != json_.end() && found->is_number() && found->get<double>() >= least &&
                      found->get<double>() <= most;
    if (!fits) refuse(op_, fmt::format("field \"{}\" must be a number from {} to {}", key, least, most));
    return static_cast<int>(found->get<double>());
  }
  int number_or(const char* key, int otherwise, int least, int most) const {
    const auto found = json_.find(key);
    return found == json_.end() || found->is_null() ? otherwise : number(key, least, most);
  }
  std::string object(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end() || !found->is_object())
      refuse(op_, fmt::format("field \"{}\" must be an object", key));
    return found->dump(-1, ' ', false, Json::error_handler_t::replace);
  }

 private:
  const Json& json_;
  std::string op_;
};

Subscribe subscribe_of(const Fields& f) {
  return {f.name("topic"),
          f.name_or("type", ""),
          f.id(),
          f.number_or("throttle_rate", 0, 0, longest_ms),
          f.number_or("queue_length", 0, 0, longest_queue),
          f.number_or("fragment_size", 0, 1, static_cast<int>(max_message_bytes)),
          f.name_or("compression", "none")};
}

Fragment fragment_of(const Fields& f) {
  Fragment fragment{f.id(), f.text("data"), f.number("num", 0, most_fragments - 1),
                    f.number("total", 1, most_fragments)};
  if (fragment.number >= fragment.total)
    refuse("fragment", fmt::format("num = {} must be less than total = {}", fragment.number, fragment.total));
  return fragment;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json with_id(Json json, const std::string& id) {
  if (!id.empty()) json["id"] = id;
  return json;
}

}  // namespace

Operation parse(std::string_view text) {
  if (text.size() > max_message_bytes)
    refuse("message", fmt::format("has {} bytes, and may have {}", text.size(), max_message_bytes));
  if (json_depth(text) > most_json_depth) refuse("message", "is nested too deep");
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) refuse("message", "must be a JSON object");
  const std::string op = Fields(json, "message").name("op");
  const Fields fields(json, op);
  if (op == "publish") return Publish{fields.name("topic"), fields.object("msg")};
  if (op == "subscribe") return subscribe_of(fields);
  if (op == "unsubscribe") return Unsubscribe{fields.name("topic"), fields.id()};
  if (op == "advertise") return Advertise{fields.name("topic"), fields.name("type"), fields.id()};
  if (op == "unadvertise") return Unadvertise{fields.name("topic"), fields.id()};
  if (op == "status") return Status{fields.name("level"), fields.text("msg"), fields.id()};
  if (op == "fragment") return fragment_of(fields);
  if (op == "call_service") return CallService{fields.name("service"), fields.id()};
  return OtherOperation{op, fields.id()};
}

std::string to_json(const Advertise& o) {
  return text_of(with_id({{"op", "advertise"}, {"topic", o.topic}, {"type", o.type}}, o.id));
}

std::string to_json(const Unadvertise& o) {
  return text_of(with_id({{"op", "unadvertise"}, {"topic", o.topic}}, o.id));
}

/// `msg` is JSON already, and may be large: it is not parsed again.
std::string to_json(const Publish& o) {
  return R"({"op":"publish","topic":)" + text_of(o.topic) + R"(,"msg":)" + o.msg + "}";
}

std::string to_json(const Subscribe& o) {
  Json json{{"op", "subscribe"},
            {"topic", o.topic},
            {"throttle_rate", o.throttle_ms},
            {"queue_length", o.queue_length},
            {"compression", o.compression}};
  if (!o.type.empty()) json["type"] = o.type;
  if (o.fragment_bytes > 0) json["fragment_size"] = o.fragment_bytes;
  return text_of(with_id(std::move(json), o.id));
}

std::string to_json(const Unsubscribe& o) {
  return text_of(with_id({{"op", "unsubscribe"}, {"topic", o.topic}}, o.id));
}

std::string to_json(const Status& o) {
  return text_of(with_id({{"op", "status"}, {"level", o.level}, {"msg", o.msg}}, o.id));
}

std::string to_json(const Fragment& o) {
  return text_of({{"op", "fragment"}, {"id", o.id}, {"data", o.data}, {"num", o.number}, {"total", o.total}});
}

std::string refused_call(const CallService& call, const std::string& why) {
  return text_of(with_id(
      {{"op", "service_response"}, {"service", call.service}, {"values", why}, {"result", false}}, call.id));
}

bool same_type(std::string_view a, std::string_view b) {
  return a.empty() || b.empty() || type_for(a, 1) == type_for(b, 1);
}

std::string type_for(std::string_view type, int ros) {
  const auto first = type.find('/'), last = type.rfind('/');
  if (first == std::string_view::npos) return std::string(type);
  const std::string_view package = type.substr(0, first), name = type.substr(last + 1);
  return fmt::format("{}/{}{}", package, ros == 2 ? "msg/" : "", name);
}

}  // namespace incognita::rosbridge
