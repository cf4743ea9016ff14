#include "vantage/dataset/render_pool.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <optional>
#include <string>

#include "vantage/core/error.hpp"
#include "vantage/core/log.hpp"
#include "vantage/core/yaml.hpp"
#include "vantage/dataset/object_renderer.hpp"
#include "vantage/dataset/render_worker.hpp"
#include "vantage/dataset/worker_process.hpp"

namespace vantage {
namespace {

constexpr int kMostDeaths = 3;  ///< of processes over one object
constexpr int kAskForStop_ms = 100;

struct Job {
  const ObjectName* name;
  int deaths = 0;
};

struct BusyWorker {
  WorkerProcess process;
  Job job;
  std::string received = {};
};

class RenderPool {
 public:
  RenderPool(const DatasetOptions& options, const DatasetRun& run,
             const std::vector<ObjectName>& names,
             const std::function<void(const ObjectName&, int views)>& done)
      : options_(to_yaml(write_node(options))), run_(run), done_(done) {
    for (const ObjectName& name : names) jobs_.push_back({&name});
  }
  RenderPool(const RenderPool&) = delete;
  RenderPool& operator=(const RenderPool&) = delete;
  /// What is begun and not finished, after a stop or an error.
  ~RenderPool() {
    std::vector<const ObjectName*> begun;
    for (const BusyWorker& worker : workers_) begun.push_back(worker.job.name);
    workers_.clear();  // none of them writes any more
    for (const ObjectName* name : begun) {
      try {
        remove_unfinished(run_.root, *name);
      } catch (const Error& error) {
        log_warning(error.what());
      }
    }
  }

  bool work() {
    while (std::ssize(workers_) < run_.jobs && !jobs_.empty()) {
      start(WorkerProcess(run_.worker));
    }
    while (!workers_.empty()) {
      if (run_.stop()) return false;
      for (const std::size_t i : ready()) hear(i);
      std::erase_if(workers_, [](const BusyWorker& worker) { return worker.job.name == nullptr; });
    }
    return true;
  }

 private:
  /// Gives the process the next job.
  void start(WorkerProcess process) {
    workers_.push_back({std::move(process), {nullptr}});
    give_job(workers_.back());
  }

  void give_job(BusyWorker& worker) {
    worker.job = jobs_.empty() ? Job{nullptr} : jobs_.front();
    if (jobs_.empty()) return;
    jobs_.pop_front();
    // One that is dead already closes its socket, which is heard.
    send_message(worker.process.socket(),
                 to_message(RenderRequestMessage{options_, run_.root.string(), *worker.job.name}));
  }

  /// Workers that have said something or ended.
  std::vector<std::size_t> ready() {
    std::vector<pollfd> sockets;
    for (const BusyWorker& worker : workers_) {
      sockets.push_back({worker.process.socket(), POLLIN, 0});
    }
    std::vector<std::size_t> found;
    if (::poll(sockets.data(), sockets.size(), kAskForStop_ms) <= 0) return found;
    for (std::size_t i = 0; i < sockets.size(); ++i) {
      if (sockets[i].revents != 0) found.push_back(i);
    }
    return found;
  }

  void hear(std::size_t index) {
    BusyWorker& worker = workers_[index];
    std::array<char, 4096> buffer;
    const ssize_t count = ::recv(worker.process.socket(), buffer.data(), buffer.size(), 0);
    if (count < 0 && errno == EINTR) return;
    if (count <= 0) return replace(worker);
    worker.received.append(buffer.data(), static_cast<std::size_t>(count));
    const auto message = take_message(worker.received);
    if (!message) return;
    const RenderAnswerMessage answer = parse_answer(*message);
    if (answer.code != ExitCode::done) throw Error(answer.code, answer.error);
    done_(*worker.job.name, answer.views);
    give_job(worker);
  }

  void replace(BusyWorker& worker) {
    const std::string end = worker.process.wait_for_end();
    Job job = worker.job;
    if (++job.deaths >= kMostDeaths) {
      throw RendererError(fmt::format("{}: {} processes died rendering it, the last by {}",
                                      job.name->object, job.deaths, end));
    }
    log_warning(fmt::format("{}: the process that rendered it died by {}; it is rendered again",
                            job.name->object, end));
    jobs_.push_front(job);
    worker = {WorkerProcess(run_.worker), {nullptr}};
    give_job(worker);
  }

  std::string options_;
  const DatasetRun& run_;
  const std::function<void(const ObjectName&, int views)>& done_;
  std::deque<Job> jobs_;  ///< not begun
  std::vector<BusyWorker> workers_;
};

}  // namespace

bool render_in_processes(const DatasetOptions& options, const DatasetRun& run,
                         const std::vector<ObjectName>& names,
                         const std::function<void(const ObjectName&, int views)>& done) {
  expects(!run.worker.empty() && run.jobs >= 1, "a program to start, at least once");
  return RenderPool(options, run, names, done).work();
}

}  // namespace vantage
