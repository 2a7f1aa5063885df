#pragma once

/// @file
/// Notices when a table file changes on disk.

#include <filesystem>

namespace carom::pinball {

class TableWatch
{
public:
    explicit TableWatch(std::filesystem::path file);
    [[nodiscard]] const std::filesystem::path& file() const { return m_file; }
    /// True once after each change. A file that is gone for a moment (editors do that) has not changed yet.
    [[nodiscard]] bool poll();

private:
    std::filesystem::path m_file;
    std::filesystem::file_time_type m_seen{};
    std::uintmax_t m_size = 0;
};

} // namespace carom::pinball
