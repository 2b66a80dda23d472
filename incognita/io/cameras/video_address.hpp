// What `live.source` names: a device, an address of the network, or a file.
#pragma once

#include <string>

namespace incognita {

bool is_device(const std::string& source);   ///< "/dev/video0"
bool is_address(const std::string& source);  ///< "rtsp://...", "http://..."

/// An address for messages: "rtsp://user:secret@host/path" becomes "rtsp://user:***@host/path", and
/// "rtsp://host/user=me&password=secret" becomes "rtsp://host/user=me&password=***".
std::string without_password(const std::string& source);

}  // namespace incognita
