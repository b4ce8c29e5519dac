#pragma once

#include <stdexcept>
#include <string>

namespace glint {

/// Base of everything that glint throws. The message is one line: what is wrong, where, what to do.
/// Thrown at the edges (files, GL, usage), caught in main.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user's input cannot be used: a wrong option, a file that cannot be read or written.
class InputError : public Error {
 public:
  using Error::Error;
};

}  // namespace glint
