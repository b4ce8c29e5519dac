#include "glint/options/process.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include "glint/image/read_files.h"

namespace glint {

void prepareProcess() {
  // open() returns the lowest free number. Standard input is opened for writing and standard output
  // for reading, so that using them fails as if they were closed: closed input must not read as an
  // empty list, nor a picture be lost silently.
  constexpr int modes[] = {O_WRONLY, O_RDONLY, O_RDWR};
  for (int number = 0; number < 3; ++number)
    if (::fcntl(number, F_GETFD) == -1 && ::open("/dev/null", modes[number]) != number) ::_exit(2);
  ::signal(SIGXFSZ, SIG_IGN);
  protectReadFiles();
}

}  // namespace glint
