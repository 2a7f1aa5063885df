#pragma once

/// @file
/// The words of a chapter. They stand in a Markdown file of their own, one a chapter and a folder a language, so that they can be translated and
/// shown elsewhere:
///
///     # Title
///     Paragraphs, parted by blank lines. {name} stands for a number of the running scene.
///
///         formulas are indented by four spaces
///
///     <!-- stage: 2 -->     the next block begins a page; while that is turned to, the slider is set so
///
///     ## Try
///     - one thing to do
///
///     ## Controls
///     - name: label of a slider or switch
///
///     ## Words
///     - name: what is written into the picture
///
///     ## On the table
///     What to look at there.

#include "view/words.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom::tour {

using view::filled;
using view::placeholders;
using view::Values;

struct Block
{
    enum class Kind
    {
        Heading,
        Paragraph,
        Formula,
        Task, ///< something to try
    };
    Kind kind = Kind::Paragraph;
    std::string text{};
    std::map<std::string, float> sets{}; ///< controls, when its page is opened; it begins one
};

struct ChapterText
{
    std::string title{};
    std::vector<Block> blocks{}; ///< what is read, in order; the last paragraph sends the reader to the table
    Values controls{};           ///< labels by the control's name
    Values words{};              ///< what the picture says, by name
};

/// Throws std::runtime_error, with the line, where the text has no title or a list entry has no name.
[[nodiscard]] ChapterText parse_text(std::string_view markdown, const std::string& file);

/// The text of the folder that comes with the program. Throws std::runtime_error where there is no such file.
[[nodiscard]] ChapterText load_text(const std::string& name, const std::string& language = "en");

} // namespace carom::tour
