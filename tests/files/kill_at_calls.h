#pragma once

#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <functional>

namespace heightlight {

/// How a process went that was to be killed at a call.
enum class TracedEnd { killed, finished, untraceable };

/// Calls that change which names there are in a file system.
inline bool changes_names(std::uint64_t call) {
  constexpr std::array kCalls{
#ifdef SYS_mkdir
      SYS_mkdir,   SYS_rmdir,    SYS_unlink,    SYS_rename, SYS_open,
#endif
      SYS_mkdirat, SYS_unlinkat, SYS_renameat2, SYS_openat};
  return std::find(kCalls.begin(), kCalls.end(), static_cast<long>(call)) != kCalls.end();
}

/// Runs `work` in a process of its own and kills it just before the call of number `kill_at`, from 0, among
/// those that change names. What it cannot trace, as where a sandbox forbids it, it leaves undone.
inline TracedEnd kill_at_call(int kill_at, const std::function<void()>& work) {
  const pid_t process = fork();
  if (process == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    raise(SIGSTOP);
    work();
    _exit(0);
  }
  int status = 0;
  waitpid(process, &status, 0);
  if (process < 0 || !WIFSTOPPED(status)) return TracedEnd::untraceable;
  constexpr std::uintptr_t kOptions = PTRACE_O_EXITKILL | PTRACE_O_TRACESYSGOOD;
  ptrace(PTRACE_SETOPTIONS, process, nullptr, kOptions);
  constexpr int kCallStop = SIGTRAP | 0x80;
  for (int calls = 0;;) {
    const int signal = WSTOPSIG(status) == kCallStop || WSTOPSIG(status) == SIGSTOP ? 0 : WSTOPSIG(status);
    if (ptrace(PTRACE_SYSCALL, process, nullptr, static_cast<std::uintptr_t>(signal)) != 0)
      return TracedEnd::untraceable;
    waitpid(process, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return TracedEnd::finished;
    if (!WIFSTOPPED(status)) return TracedEnd::untraceable;
    if (WSTOPSIG(status) != kCallStop) continue;
    struct __ptrace_syscall_info call {};
    if (ptrace(PTRACE_GET_SYSCALL_INFO, process, sizeof call, &call) <= 0) return TracedEnd::untraceable;
    if (call.op != PTRACE_SYSCALL_INFO_ENTRY || !changes_names(call.entry.nr) || calls++ < kill_at) continue;
    kill(process, SIGKILL);
    waitpid(process, &status, 0);
    return TracedEnd::killed;
  }
}

}  // namespace heightlight
