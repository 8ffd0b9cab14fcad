/// The errors of set-up: what a machine or a file refuses before a trial begins. They are thrown by
/// constructors and readers and caught once, in main. What happens while a trial runs is data (FlipReport,
/// GazeSample), never an exception.
#pragma once

#include <stdexcept>
#include <string>

namespace overt {

/// Base of all errors that overt throws on purpose. what() is a whole sentence for the experimenter: what is
/// wrong, where, and the remedy if there is one.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Something the user wrote or gave is wrong (protocol, mesh, picture, argument): exit code 2.
class InputError : public Error {
  public:
    using Error::Error;
};

/// The graphics system refuses a context, a format or a shader: exit code 1.
class GraphicsError : public Error {
  public:
    using Error::Error;
};

/// A device is missing, silent or answers nonsense: exit code 1.
class DeviceError : public Error {
  public:
    using Error::Error;
};

/// The session record cannot be written or read (disk full, damaged file): exit code 1.
class RecordError : public Error {
  public:
    using Error::Error;
};

/// A promise of our own code was broken. Prints the condition with its place and aborts.
[[noreturn]] void broken_promise(const char* condition, const char* file, int line);

} // namespace overt

/// States what must hold here if the program is right; kept in release builds.
#define OVERT_EXPECTS(condition)                                                                             \
    do {                                                                                                     \
        if (!(condition))                                                                                    \
            ::overt::broken_promise(#condition, __FILE__, __LINE__);                                         \
    } while (false)
