#include "view/synth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace carom::view {
namespace {

double rms(std::span<const float> samples)
{
    double sum = 0;
    for (const float s : samples)
        sum += static_cast<double>(s) * static_cast<double>(s);
    return std::sqrt(sum / static_cast<double>(samples.size()));
}

std::vector<float> render(Synth& synth, int frames)
{
    std::vector<float> stereo(2 * static_cast<std::size_t>(frames));
    synth.render(stereo);
    return stereo;
}

double loudness_of(const Strike& strike)
{
    Synth synth;
    synth.play(strike);
    return rms(render(synth, 9600));
}

TEST(Synth, SilentUntilStruckAndSilentAfterTheDecay)
{
    Synth synth;
    EXPECT_EQ(rms(render(synth, 1000)), 0);
    synth.play({.decay_s = 0.1f});
    EXPECT_GT(rms(render(synth, 1000)), 0.05);
    render(synth, 24000);
    EXPECT_EQ(synth.sounding(), 0);
    EXPECT_EQ(rms(render(synth, 1000)), 0);
}

TEST(Synth, DecayTimeIsTheTimeToAThousandth)
{
    Synth synth;
    synth.play({.pitch_hz = 1000, .brightness = 0, .noise = 0, .decay_s = 0.5f, .loudness = 0.6f});
    const double start = rms(render(synth, 960));
    render(synth, 24000 - 2 * 960);
    render(synth, 960);
    const double end = rms(render(synth, 960));
    EXPECT_NEAR(20 * std::log10(end / start), -60, 3);
}

TEST(Synth, LoudnessFollowsTheImpulse)
{
    double before = 0;
    for (const float impulse : {0.01f, 0.05f, 0.2f, 0.5f, 1.0f})
    {
        const double heard = loudness_of({.loudness = loudness_of_impulse(impulse, 1)});
        EXPECT_GT(heard, 1.3 * before) << "impulse " << impulse;
        before = heard;
    }
}

TEST(Synth, LoudnessOfImpulseKnowsItsEnds)
{
    EXPECT_EQ(loudness_of_impulse(0, 1), 0);
    EXPECT_EQ(loudness_of_impulse(-1, 1), 0);
    EXPECT_EQ(loudness_of_impulse(NAN, 1), 0);
    EXPECT_EQ(loudness_of_impulse(7, 1), 1);
    EXPECT_NEAR(loudness_of_impulse(0.1f, 1), 0.25, 0.01);
}

TEST(Synth, PanMovesSoundToOneSide)
{
    Synth synth;
    synth.play({.pan = 1});
    const std::vector<float> stereo = render(synth, 4800);
    double left = 0;
    double right = 0;
    for (std::size_t i = 0; i < stereo.size(); i += 2)
    {
        left += std::abs(static_cast<double>(stereo[i]));
        right += std::abs(static_cast<double>(stereo[i + 1]));
    }
    EXPECT_LT(left, 1e-3 * right);
}

TEST(Synth, NeverLeavesTheRangeHoweverManySound)
{
    Synth synth;
    for (int i = 0; i < 200; ++i)
        synth.play({.pitch_hz = 100.0f + 13.0f * static_cast<float>(i), .loudness = 1});
    synth.set_drone(0, {.loudness = 1});
    for (const float s : render(synth, 48000))
        ASSERT_LE(std::abs(s), 1.0f);
    EXPECT_LE(synth.sounding(), Synth::max_voices);
}

// Zero crossings of a pure tone tell its pitch.
TEST(Synth, PitchIsTheOneAskedFor)
{
    Synth synth;
    synth.play({.pitch_hz = 500, .brightness = 0, .noise = 0, .decay_s = 10, .loudness = 0.5f});
    const std::vector<float> stereo = render(synth, 48000);
    int crossings = 0;
    for (std::size_t i = 2; i < stereo.size(); i += 2)
        crossings += stereo[i - 2] < 0 && stereo[i] >= 0;
    EXPECT_NEAR(crossings, 500, 2);
}

TEST(Synth, BrightSoundHasMoreEdges)
{
    const auto edges = [](float brightness)
    {
        Synth synth;
        synth.play({.pitch_hz = 400, .brightness = brightness, .noise = 0, .decay_s = 2, .loudness = 0.6f});
        const std::vector<float> s = render(synth, 4800);
        double sum = 0;
        for (std::size_t i = 2; i < s.size(); i += 2)
            sum += std::abs(static_cast<double>(s[i] - s[i - 2]));
        return sum;
    };
    EXPECT_GT(edges(0.5f), 1.3 * edges(0));
}

TEST(Synth, DroneSwellsAndStops)
{
    Synth synth;
    synth.set_drone(2, {.pitch_hz = 200, .loudness = 0.5f});
    render(synth, 9600);
    EXPECT_GT(rms(render(synth, 4800)), 0.02);
    synth.set_drone(2, {.pitch_hz = 200, .loudness = 0});
    render(synth, 48000);
    EXPECT_EQ(rms(render(synth, 4800)), 0);
}

TEST(Synth, VolumeZeroIsSilence)
{
    Synth synth;
    synth.set_volume(0);
    render(synth, 48000);
    synth.play({.decay_s = 2});
    EXPECT_LT(rms(render(synth, 4800)), 1e-6);
}

TEST(Synth, SameCallsGiveTheSameSamples)
{
    Synth a;
    Synth b;
    a.play({.noise = 0.5f});
    b.play({.noise = 0.5f});
    EXPECT_EQ(render(a, 4800), render(b, 4800));
}

} // namespace
} // namespace carom::view
