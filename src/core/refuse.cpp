// Error handling: the exception, the handler, and the checks that build error messages.

#include "core/refuse.h"

#include "carom/config.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace carom {

struct Error::Sentence
{
    std::string text;
    std::atomic<int> owners{1};
};

Error::Error(const char* sentence) : m_sentence(new Sentence{sentence}) {}
Error::Error(const Error& other) noexcept : std::exception(other), m_sentence(other.m_sentence) { ++m_sentence->owners; }

Error& Error::operator=(const Error& other) noexcept
{
    Error copy(other);
    std::swap(m_sentence, copy.m_sentence);
    return *this;
}

Error::~Error()
{
    if (--m_sentence->owners == 0)
        delete m_sentence;
}

const char* Error::what() const noexcept { return m_sentence->text.c_str(); }

namespace {

[[maybe_unused]] void print_and_abort(const char* sentence)
{
    std::fprintf(stderr, "%s\n", sentence);
    std::abort();
}

ErrorHandler g_handler = print_and_abort;

} // namespace

ErrorHandler set_error_handler(ErrorHandler handler)
{
    ErrorHandler previous = g_handler;
    g_handler = handler != nullptr ? handler : print_and_abort;
    return previous;
}

namespace internal {

bool refuse(const char* function, const char* field, const std::string& value, const char* rule)
{
    const std::string sentence = std::string(function) + ": " + field + " is " + value + ", but " + rule;
#if CAROM_EXCEPTIONS
    throw Error(sentence.c_str());
#else
    g_handler(sentence.c_str());
    return false;
#endif
}

std::string to_text(double value)
{
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.9g", value);
    return buffer;
}

std::string to_text(Vec2 value) { return "(" + to_text(value.x) + ", " + to_text(value.y) + ")"; }
std::string to_text(Position value) { return "(" + to_text(value.x) + ", " + to_text(value.y) + ")"; }

bool Checker::positive(const char* field, float value) const
{
    return (is_finite(value) && value > 0) || refuse(function, field, to_text(value), "must be finite and > 0");
}

bool Checker::not_negative(const char* field, float value) const
{
    return (is_finite(value) && value >= 0) || refuse(function, field, to_text(value), "must be finite and >= 0");
}

bool Checker::in_range(const char* field, float value, float low, float high) const
{
    if (value >= low && value <= high)
        return true;
    return refuse(function, field, to_text(value), ("must be from " + to_text(low) + " to " + to_text(high)).c_str());
}

bool Checker::holds(bool condition, const char* field, const std::string& value, const char* rule) const
{
    return condition || refuse(function, field, value, rule);
}

} // namespace internal
} // namespace carom
