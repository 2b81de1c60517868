// tests/window/virtual_display.h

#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace penumbra {

// An X server of our own, as long as this lives; DISPLAY names it.
class VirtualDisplay {
 public:
  VirtualDisplay() {
    int ends[2];
    if (pipe(ends) != 0) return;
    server_ = fork();
    if (server_ == 0) {
      close(ends[0]);
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDERR_FILENO);
      const std::string number = std::to_string(ends[1]);
      // The server finds a free display itself, and writes its number once it is ready.
      execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1400x1000x24", "-nolisten", "tcp",
             nullptr);
      _exit(127);
    }
    close(ends[1]);
    std::string name;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) name += c;
    close(ends[0]);
    if (!name.empty()) setenv("DISPLAY", (":" + name).c_str(), 1);
    ready_ = !name.empty();
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    unsetenv("WAYLAND_DISPLAY");
  }
  ~VirtualDisplay() {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  bool ready() const { return ready_; }

 private:
  pid_t server_ = -1;
  bool ready_ = false;
};

}  // namespace penumbra
