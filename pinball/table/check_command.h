#pragma once

#include <filesystem>
#include <ostream>

namespace carom::pinball {

/// `carom-pinball check FILE`: prints every error and finding, one a line. 0 if there is none, else 1.
int check_command(const std::filesystem::path& file, std::ostream& out);

} // namespace carom::pinball
