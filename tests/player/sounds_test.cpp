#include "pinball/player/sounds.h"

#include "pinball/table/loader.h"

#include <SDL.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace carom::pinball {
namespace {

const Table& momentum()
{
    static const Table table = *load_table_file(CAROM_TABLES_DIR "/momentum.table.json").table;
    return table;
}

GameEvent impact(const char* element, float impulse)
{
    return {.kind = EventKind::Impact, .element = momentum().find(element), .point = {0.23, 0.5}, .impulse = impulse};
}

// The output of SDL's disk driver: raw floats, left and right in turn.
std::vector<float> record(const view::Strike& strike)
{
    const std::string path = testing::TempDir() + "carom_player_sound_" + std::to_string(getpid()) + ".raw";
    setenv("SDL_AUDIODRIVER", "disk", 1);
    setenv("SDL_DISKAUDIOFILE", path.c_str(), 1);
    setenv("SDL_DISKAUDIODELAY", "1", 1);
    const auto bytes = [&]
    {
        std::ifstream in(path, std::ios::binary | std::ios::ate);
        return in ? static_cast<std::size_t>(in.tellg()) : std::size_t{0};
    };
    {
        view::SoundSink sink;
        EXPECT_TRUE(sink.available()) << sink.why_mute();
        sink.play(strike);
        // 40,000 frames are most of a second: longer than any blow sounds.
        for (int i = 0; i < 5000 && bytes() < 40'000 * 2 * sizeof(float); ++i)
            SDL_Delay(1);
    }
    std::vector<float> samples(bytes() / sizeof(float));
    std::ifstream in(path, std::ios::binary);
    in.read(reinterpret_cast<char*>(samples.data()), static_cast<std::streamsize>(samples.size() * sizeof(float)));
    std::remove(path.c_str());
    unsetenv("SDL_AUDIODRIVER");
    samples.resize(std::min<std::size_t>(samples.size(), 80'000));
    return samples;
}

double rms(const std::vector<float>& samples)
{
    double sum = 0;
    for (const float s : samples)
        sum += static_cast<double>(s) * static_cast<double>(s);
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(samples.size(), 1)));
}

TEST(PlayerSounds, AHarderHitIsLouderThroughTheSoundCard)
{
    double before = 0;
    for (const float impulse : {0.01f, 0.05f, 0.25f})
    {
        const auto strike = strike_of(momentum(), impact("island_left", impulse));
        ASSERT_TRUE(strike);
        const auto samples = record(*strike);
        ASSERT_GE(samples.size(), 80'000u);
        const double now = rms(samples);
        EXPECT_GT(now, 1.5 * before) << impulse;
        EXPECT_GT(now, 1e-5);
        before = now;
    }
}

TEST(PlayerSounds, ATouchOfARollingBallIsSilent) { EXPECT_FALSE(strike_of(momentum(), impact("outer", 1e-4f))); }

TEST(PlayerSounds, TheMaterialDecidesTheSoundOfABlow)
{
    const auto pitch = [](const char* element) { return strike_of(momentum(), impact(element, 0.1f))->pitch_hz; };
    EXPECT_GT(pitch("lane_guide_2"), pitch("island_left")); // metal, plastic
    EXPECT_GT(pitch("island_left"), pitch("outer"));        // wood
    EXPECT_GT(pitch("outer"), pitch("captive_post_l"));     // rubber
    const auto balls = strike_of(momentum(), {.kind = EventKind::Impact, .impulse = 0.1f});
    EXPECT_GT(balls->pitch_hz, pitch("lane_guide_2"));
}

TEST(PlayerSounds, AHitOnTheLeftIsHeardOnTheLeft)
{
    GameEvent event = impact("outer", 0.1f);
    event.point = {0.02, 0.5};
    EXPECT_LT(strike_of(momentum(), event)->pan, -0.5f);
    event.point = {0.49, 0.5};
    EXPECT_GT(strike_of(momentum(), event)->pan, 0.5f);
}

TEST(PlayerSounds, DevicesSound)
{
    for (const EventKind kind : {EventKind::Fired, EventKind::Fell, EventKind::Raised, EventKind::Spun, EventKind::Drained,
                                 EventKind::Launched, EventKind::FlipperCoil, EventKind::FlipperStop, EventKind::PlungerReleased})
    {
        const auto strike = strike_of(momentum(), {.kind = kind, .element = momentum().find("pop1"), .speed = 10, .value = 1});
        ASSERT_TRUE(strike) << static_cast<int>(kind);
        EXPECT_GT(strike->loudness, 0);
    }
    const auto lane = [](const char* id)
    { return strike_of(momentum(), {.kind = EventKind::Entered, .element = momentum().find(id)}); };
    ASSERT_TRUE(lane("top1") && lane("top2"));
    EXPECT_GT(lane("top2")->pitch_hz, lane("top1")->pitch_hz);
    EXPECT_FALSE(lane("shooter"));
}

TEST(PlayerSounds, RollingIsLouderTheFasterTheBall)
{
    Game game(momentum(), {.seed = 1});
    const float resting = rolling_noise(game).loudness;
    EXPECT_LT(resting, 0.001f);
    game.step({.start = true});
    for (int i = 0; i < 1500; ++i)
        game.step({.plunger = i > 200 && i < 1100});
    float fastest = 0;
    float loudest = 0;
    for (int i = 0; i < 1500; ++i)
    {
        game.step({});
        for (const BallState& ball : game.balls())
            fastest = std::max(fastest, length(ball.velocity));
        loudest = std::max(loudest, rolling_noise(game).loudness);
    }
    ASSERT_GT(fastest, 0.5f);
    EXPECT_GT(loudest, 0.02f);
}

} // namespace
} // namespace carom::pinball
