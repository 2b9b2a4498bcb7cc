#pragma once

namespace heightlight {

/// From now on SIGINT and SIGTERM are noted instead of ending the process at once.
void note_interrupts();

/// Throws Interrupted once a noted signal has arrived. Long loops call it between pieces of work.
void throw_if_interrupted();

/// The same question without the throw, for use inside a parallel region.
bool is_interrupted();

}  // namespace heightlight
