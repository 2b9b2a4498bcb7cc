#include <malloc.h>

#include "cli/command_line.h"

int main(int argument_count, char** arguments) {
  // What is freed goes back at once, and not into arenas of many threads or below what is still in use: the
  // peak is then that of what is held, which --memory promises.
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  return heightlight::run_command_line(argument_count, arguments);
}
