// Operations of the rosbridge protocol, version 2: JSON objects with a field `op`. Source: ROSBRIDGE_PROTOCOL.md of
// RobotWebTools/rosbridge_suite, Sections 3.1 and 3.2; `status` and `set_level` as in its version for ROS 1, Section 3.1.3.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace incognita::rosbridge {

/// Longest message that is accepted: an uncompressed image of 1920x1080 pixels, 3 bytes each, as base64.
constexpr std::size_t max_message_bytes = std::size_t{8} << 20;

struct Advertise {
  std::string topic, type;
  std::string id = {};
};
struct Unadvertise {
  std::string topic;
  std::string id = {};
};
struct Publish {
  std::string topic;
  std::string msg;  ///< a JSON object
};
struct Subscribe {
  std::string topic;
  std::string type = {};  ///< empty: that of the topic
  std::string id = {};
  int throttle_ms = 0;     ///< least time between messages
  int queue_length = 0;    ///< messages that may wait; 0: none, the newest replaces one that waits
  int fragment_bytes = 0;  ///< longest message; 0: any
  std::string compression = "none";
};
struct Unsubscribe {
  std::string topic;
  std::string id = {};  ///< empty: all subscriptions of the topic
};
struct Status {
  std::string level;  ///< error, warning, info or none
  std::string msg;
  std::string id = {};
};
struct Fragment {
  std::string id;
  std::string data;
  int number = 0;  ///< from 0
  int total = 1;
};
struct CallService {
  std::string service;
  std::string id = {};
};
/// An operation that is not used here, e.g. of an action.
struct OtherOperation {
  std::string op;
  std::string id = {};
};

using Operation = std::variant<Advertise, Unadvertise, Publish, Subscribe, Unsubscribe, Status, Fragment,
                               CallService, OtherOperation>;

/// Throws InputError that names the operation and the field, for anything that is not an operation. An integer `id` is read as
/// text, as the protocol allows both.
Operation parse(std::string_view json);

std::string to_json(const Advertise& operation);
std::string to_json(const Unadvertise& operation);
std::string to_json(const Publish& operation);
std::string to_json(const Subscribe& operation);
std::string to_json(const Unsubscribe& operation);
std::string to_json(const Status& operation);
std::string to_json(const Fragment& operation);
/// The answer to a call of a service that does not exist here.
std::string refused_call(const CallService& call, const std::string& why);

/// Whether two types are the same message: "geometry_msgs/Twist" (ROS 1) and "geometry_msgs/msg/Twist" (ROS 2) are. An
/// empty type fits any.
bool same_type(std::string_view a, std::string_view b);
/// The type as ROS of that generation, 1 or 2, writes it.
std::string type_for(std::string_view type, int ros);

}  // namespace incognita::rosbridge
