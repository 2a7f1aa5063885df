#pragma once

/// @file
/// How bad input is refused: one sentence that names the function, the field and the value; the scene is unchanged.

#include "carom/config.h"

#include <stdexcept>
#include <string>

namespace carom {

/// Thrown by every public function that refuses its input.
class Error : public std::invalid_argument
{
public:
    using std::invalid_argument::invalid_argument;
};

/// Receives the sentence where the library is built without exceptions. If it returns, the function that refused
/// does nothing and returns a default value (a null id, an empty list).
using ErrorHandler = void (*)(const char* sentence);

/// Replaces the handler used in builds without exceptions. The default prints the sentence to stderr and aborts.
/// Null restores the default. Returns the handler it replaces. Not thread-safe: set it before the first scene.
ErrorHandler set_error_handler(ErrorHandler handler);

} // namespace carom
