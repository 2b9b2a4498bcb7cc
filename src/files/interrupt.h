#pragma once

namespace heightlight {

/// Makes signals that ask a process to end (SIGINT, SIGTERM, SIGHUP, SIGUSR1, …) be noted instead of ending
/// the process at once, unless they are already ignored. SIGXFSZ is ignored, so that a write beyond the file
/// size limit fails instead. SIGCHLD gets its default handler back, since a parent that ignores it would hide
/// how children end. If the process has not ended by itself 0.7 s after a signal (for example inside a
/// library that knows nothing of this), `when_late` is called with the signal, on a thread of its own; it
/// must end the process. Throws std::system_error when no thread can be started.
void note_interrupts(void (*when_late)(int signal_number));

/// The signal that was noted; 0 if none was.
int noted_signal();

/// Throws Cancelled once a noted signal has arrived. Long loops call it between pieces of work.
void throw_if_interrupted();

}  // namespace heightlight
