#pragma once

/// @file
/// Sentences by name, from files beside the code, so that they can be translated. A Markdown list: "- name: A sentence with {values}."

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace carom::view {

/// Numbers and names for {placeholders}.
using Values = std::map<std::string, std::string, std::less<>>;

/// The text with its placeholders filled in; one without a value stays as it is.
[[nodiscard]] std::string filled(std::string_view text, const Values& values);

/// The names between braces.
[[nodiscard]] std::vector<std::string> placeholders(std::string_view text);

/// The sentences of "- name: sentence" lines; other lines are headings and notes.
[[nodiscard]] Values parse_words(std::string_view markdown);

/// A sentence of the stories of impacts and bodies. One that the file does not have is its name in braces.
[[nodiscard]] std::string say(std::string_view name, const Values& values = {});

} // namespace carom::view
