#pragma once

namespace heightlight {

/// From now on signals that ask a process to end (SIGINT, SIGTERM, SIGHUP, SIGUSR1, …) are noted instead of
/// ending the process at once, unless they are ignored already; SIGXFSZ is ignored, so that a write past the
/// limit on files fails instead, and SIGCHLD has its default again, since a parent that ignores it would hide
/// how children end. Where the process has not ended by itself 0.7 s later (inside a library, say, that knows
/// nothing of this), `when_late` is called on a thread of its own, with the signal; it must end the process.
/// Throws std::system_error when no thread can be started.
void note_interrupts(void (*when_late)(int signal_number));

/// The signal that was noted; 0 where none was.
int noted_signal();

/// Throws Cancelled once a noted signal has arrived. Long loops call it between pieces of work.
void throw_if_interrupted();

}  // namespace heightlight
