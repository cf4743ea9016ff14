#include "vantage/dataset/render_worker.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <exception>

#include "vantage/core/bytes.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/object_renderer.hpp"

namespace vantage {
namespace {

using Length = std::uint32_t;

std::string with_length(const std::string& content) {
  std::string message;
  put_text(message, content);
  return message;
}

RenderRequestMessage parse_request(const std::string& message) {
  ByteReader reader(message, "what to render");
  RenderRequestMessage request;
  request.options = reader.text("the options");
  request.root = reader.text("the folder");
  request.name = {reader.text("the category"), reader.text("the object")};
  reader.finish();
  return request;
}

/// The next message; nothing at the end.
std::optional<std::string> receive_message(int socket) {
  std::string received;
  std::array<char, 4096> buffer;
  while (true) {
    if (auto message = take_message(received)) return message;
    const ssize_t count = ::recv(socket, buffer.data(), buffer.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    received.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// Keeps its renderer from one object to the next of the same dataset.
class Server {
 public:
  RenderAnswerMessage answer(const RenderRequestMessage& request) {
    try {
      if (!renderer_ || request.options != options_ || request.root != root_) prepare(request);
      return {.views = *renderer_->render(request.name, [] { return false; }), .error = {}};
    } catch (const Error& error) {
      return {error.code(), 0, error.what()};
    } catch (const std::exception& error) {
      return {ExitCode::internal, 0, error.what()};
    }
  }

 private:
  void prepare(const RenderRequestMessage& request) {
    renderer_.reset();
    DatasetOptions options;
    read_into(parse_yaml(request.options, "options"), options, {});
    renderer_.emplace(options, request.root);
    options_ = request.options;
    root_ = request.root;
  }

  std::string options_;
  std::string root_;
  std::optional<ObjectRenderer> renderer_;
};

}  // namespace

std::string to_message(const RenderRequestMessage& request) {
  std::string content;
  for (const std::string& text :
       {request.options, request.root, request.name.category, request.name.object}) {
    put_text(content, text);
  }
  return with_length(content);
}

std::string to_message(const RenderAnswerMessage& answer) {
  std::string content;
  put(content, static_cast<std::int32_t>(answer.code));
  put(content, static_cast<std::int32_t>(answer.views));
  put_text(content, answer.error);
  return with_length(content);
}

std::optional<std::string> take_message(std::string& received) {
  Length length = 0;
  if (received.size() < sizeof length) return std::nullopt;
  std::memcpy(&length, received.data(), sizeof length);
  if (received.size() - sizeof length < length) return std::nullopt;
  std::string message = received.substr(sizeof length, length);
  received.erase(0, sizeof length + length);
  return message;
}

RenderAnswerMessage parse_answer(const std::string& message) {
  ByteReader reader(message, "answer of a renderer");
  RenderAnswerMessage answer;
  answer.code = static_cast<ExitCode>(reader.number<std::int32_t>("the code"));
  answer.views = reader.number<std::int32_t>("the views");
  answer.error = reader.text("the error");
  reader.finish();
  return answer;
}

bool send_message(int socket, const std::string& message) {
  std::string_view left = message;
  while (!left.empty()) {
    const ssize_t count = ::send(socket, left.data(), left.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

ExitCode serve_rendering(int socket) {
  Server server;
  while (const auto message = receive_message(socket)) {
    if (!send_message(socket, to_message(server.answer(parse_request(*message))))) break;
  }
  return ExitCode::done;
}

}  // namespace vantage
