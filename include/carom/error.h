#pragma once

/// @file
/// How bad input is refused: one sentence that names the function, the field and the value; the scene is unchanged.

#include "carom/config.h"

#include <exception>

namespace carom {

/// Thrown by every public function that refuses its input.
class CAROM_API Error : public std::exception
{
public:
    explicit Error(const char* sentence); ///< keeps a copy, which copies of the error share
    Error(const Error& other) noexcept;
    Error& operator=(const Error& other) noexcept;
    ~Error() override;

    /// "Scene::update: dt is nan, but must be finite and > 0".
    [[nodiscard]] const char* what() const noexcept override;

private:
    struct Sentence;
    Sentence* m_sentence;
};

/// Receives the sentence where the library is built without exceptions. If it returns, the function that refused
/// does nothing and returns a default value (a null id, an empty list).
using ErrorHandler = void (*)(const char* sentence);

/// Replaces the handler used in builds without exceptions. The default prints the sentence to stderr and aborts.
/// Null restores the default. Returns the handler it replaces. Not thread-safe: set it before the first scene.
CAROM_API ErrorHandler set_error_handler(ErrorHandler handler);

} // namespace carom
