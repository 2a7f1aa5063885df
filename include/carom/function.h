#pragma once

/// @file
/// Callbacks of scenes. Like std::function, whose header alone takes half as long to compile as all of Carom's.

#include <cstddef>
#include <type_traits>
#include <utility>

namespace carom {

template <class Signature>
class Function;

/// A callable that can be copied, such as a lambda, with its own copy of what it captures. Empty by default, and where it is made of an empty one.
template <class Result, class... Arguments>
class Function<Result(Arguments...)>
{
public:
    Function() = default;
    Function(std::nullptr_t) {}
    template <class Callable>
        requires(!std::is_same_v<std::decay_t<Callable>, Function> &&
                 requires(std::decay_t<Callable>& callable, Arguments... arguments) {
                     callable(std::forward<Arguments>(arguments)...);
                 })
    Function(Callable&& callable)
    {
        if constexpr (!std::is_function_v<std::remove_reference_t<Callable>> &&
                      requires { static_cast<bool>(callable == nullptr); })
        {
            if (callable == nullptr)
                return;
        }
        m_target = new Held<std::decay_t<Callable>>(std::forward<Callable>(callable));
    }
    Function(const Function& other) : m_target(other.m_target != nullptr ? other.m_target->copy() : nullptr) {}
    Function(Function&& other) noexcept : m_target(std::exchange(other.m_target, nullptr)) {}
    Function& operator=(Function other) noexcept
    {
        std::swap(m_target, other.m_target);
        return *this;
    }
    ~Function() { delete m_target; }

    /// True where there is something to call.
    [[nodiscard]] explicit operator bool() const { return m_target != nullptr; }
    [[nodiscard]] friend bool operator==(const Function& function, std::nullptr_t) { return function.m_target == nullptr; }

    /// Not of an empty one.
    Result operator()(Arguments... arguments) const { return m_target->call(std::forward<Arguments>(arguments)...); }

private:
    struct Target
    {
        virtual ~Target() = default;
        virtual Result call(Arguments... arguments) = 0;
        [[nodiscard]] virtual Target* copy() const = 0;
    };

    template <class Callable>
    struct Held final : Target
    {
        template <class From>
        explicit Held(From&& from) : callable(std::forward<From>(from))
        {}
        Result call(Arguments... arguments) override
        {
            if constexpr (std::is_void_v<Result>)
                callable(std::forward<Arguments>(arguments)...);
            else
                return callable(std::forward<Arguments>(arguments)...);
        }
        [[nodiscard]] Target* copy() const override { return new Held(callable); }

        Callable callable;
    };

    Target* m_target = nullptr;
};

} // namespace carom
