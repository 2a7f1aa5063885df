#include "pinball/player/attract.h"

#include "pinball/player/score_panel.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace carom::pinball {

namespace {

constexpr double page_time = 3.5; // s
constexpr std::size_t places_shown = 4;

std::string capitals(std::string text)
{
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

} // namespace

std::vector<DisplayPage> attract_pages(const Machine& machine)
{
    const Game& game = machine.game();
    const std::string start = "PRESS " + capitals(machine.controls.label(Button::Start));
    std::vector<DisplayPage> pages;
    if (game.phase() == Phase::GameOver)
        for (int player = 0; player < game.players(); ++player)
            pages.push_back(
                {with_commas(game.score(player)), game.players() > 1 ? "PLAYER " + std::to_string(player + 1) : "GAME OVER"});
    pages.push_back({capitals(game.table().name), start});
    pages.push_back({"1-4", "PLAYERS  " + start});
    if (game.credits() > 0)
        pages.push_back({std::to_string(game.credits()), game.credits() > 1 ? "FREE GAMES" : "FREE GAME"});
    if (const auto& replay = game.table().rules.replay)
        pages.push_back({with_commas(replay->score), replay->wins_a_ball ? "WINS AN EXTRA BALL" : "WINS A GAME"});
    const auto& entries = game.high_scores().entries();
    for (std::size_t i = 0; i < std::min(entries.size(), places_shown); ++i)
        pages.push_back({with_commas(entries[i].score),
                         i == 0 ? "BEST  " + entries[i].name : std::to_string(i + 1) + "  " + entries[i].name});
    return pages;
}

DisplayPage attract_page(const Machine& machine, double time)
{
    const std::vector<DisplayPage> pages = attract_pages(machine);
    return pages[static_cast<std::size_t>(time / page_time) % pages.size()];
}

} // namespace carom::pinball
