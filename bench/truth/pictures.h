#pragma once

/// @file
/// Pictures of experiments 1, 6 and 15 over all engines.

#include "truth/experiment.h"

#include <filesystem>

namespace truth {

struct Picture
{
    int experiment = 0;
    std::string file{};
    void (*draw)(const std::vector<Setup>& setups, const std::filesystem::path& file) = nullptr;
};

[[nodiscard]] std::span<const Picture> pictures();

} // namespace truth
