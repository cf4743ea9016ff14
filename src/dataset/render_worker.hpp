/// Objects are rendered by processes of their own: threads of one process that each have an OpenGL
/// context of OSMesa die now and then. A process that dies takes no other with it.
#pragma once

#include <optional>
#include <string>

#include "vantage/core/error.hpp"
#include "vantage/dataset/object_source.hpp"

namespace vantage {

/// What a worker is asked, and what it answers; each goes through a socket after its length.
struct RenderRequestMessage {
  std::string options;  ///< DatasetOptions as YAML
  std::string root;
  ObjectName name;
};
struct RenderAnswerMessage {
  ExitCode code = ExitCode::done;
  int views = 0;
  std::string error;  ///< if the code is not `done`
};
std::string to_message(const RenderRequestMessage& request);
std::string to_message(const RenderAnswerMessage& answer);
/// Takes the first whole message off the front of `received`; nothing if there is none yet.
std::optional<std::string> take_message(std::string& received);
/// @throws InputError if the bytes are not those of an answer.
RenderAnswerMessage parse_answer(const std::string& message);

/// Sends all of it. @returns false if nobody reads it any more.
bool send_message(int socket, const std::string& message);

/// What a worker does: renders what it is asked for through `socket` until that is closed.
ExitCode serve_rendering(int socket);

}  // namespace vantage
