// SPDX-License-Identifier: BSD-3-Clause
// Long work in a thread of its own, while the thread that called waits with the lock of the interpreter released.
//
// Two reasons for the thread. The calling one can look for Ctrl-C and for a request to stop. And the OpenMP runtime keeps its
// threads for each thread that starts a parallel loop: with a new one for each piece of work, nothing of them is left when the
// process forks later, and loops in the child start threads of their own instead of waiting for ones that it does not have.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace dem {

/// What the working thread has for the waiting one; it waits until it was taken.
template <class Event>
class Letterbox {
 public:
  /// By the working thread: returns when the event was handled.
  void put(Event event) {
    std::unique_lock lock(mutex_);
    event_ = std::move(event);
    changed_.notify_all();
    changed_.wait(lock, [&] { return !event_.has_value(); });
  }
  /// By the working thread, last of all.
  void close(std::exception_ptr thrown) {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    thrown_ = std::move(thrown);
    changed_.notify_all();
  }
  /// By the waiting thread: true when there is an event or an end.
  bool wait(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, longest, [&] { return event_.has_value() || is_closed_; });
  }
  [[nodiscard]] std::optional<Event> look() {
    const std::lock_guard lock(mutex_);
    return event_;
  }
  /// The event was handled.
  void empty() {
    const std::lock_guard lock(mutex_);
    event_.reset();
    changed_.notify_all();
  }
  [[nodiscard]] bool is_closed() {
    const std::lock_guard lock(mutex_);
    return is_closed_;
  }
  [[nodiscard]] std::exception_ptr thrown() const { return thrown_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Event> event_;
  bool is_closed_ = false;
  std::exception_ptr thrown_;
};

/// How often the waiting thread looks for Ctrl-C and asks whether to stop.
inline constexpr std::chrono::milliseconds k_look_interval{50};

/// Runs work(box) in a thread of its own. In the calling thread, with the lock of the interpreter held: `handle` takes every
/// event, `look` is called every k_look_interval, `stop` once when one of them, or Ctrl-C, raised an exception; the work should
/// then end soon. That exception is thrown on when the work has ended, before any of the work.
/// Throws std::runtime_error in a child process that was forked inside of a handler and returns here: the work goes on in the
/// parent alone.
template <class Event>
void run_beside(std::function<void(Letterbox<Event>&)> work, const std::function<void(const Event&)>& handle,
                const std::function<void()>& look, const std::function<void()>& stop) {
  namespace py = pybind11;
  const auto box = std::make_shared<Letterbox<Event>>();
  const pid_t owner = ::getpid();
  std::exception_ptr raised;
  std::thread thread([box, work = std::move(work)] {
    try {
      work(*box);
      box->close(nullptr);
    } catch (...) {
      box->close(std::current_exception());
    }
  });
  while (!box->is_closed()) {
    {
      const py::gil_scoped_release unlocked;
      box->wait(k_look_interval);
    }
    const std::optional<Event> event = box->look();
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!raised) {
        look();
        if (event) handle(*event);
      }
    } catch (...) {
      if (!raised) stop();
      raised = std::current_exception();
    }
    if (::getpid() != owner) {
      thread.detach();  // there is none: threads other than the forking one are not in the child
      throw std::runtime_error(
          "a process that was forked inside of a callback cannot go on with what its parent is running");
    }
    if (event) box->empty();
  }
  {
    const py::gil_scoped_release unlocked;
    thread.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (box->thrown()) std::rethrow_exception(box->thrown());
}

/// The same for work that tells nothing and cannot be stopped on its way; Ctrl-C is heard when it has ended.
inline void run_beside(const std::function<void()>& work) {
  run_beside<int>([&](Letterbox<int>&) { work(); }, [](const int&) {}, [] {}, [] {});
}

}  // namespace dem
