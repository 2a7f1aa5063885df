#include "view/sound_sink.h"

#include <SDL.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace carom::view {
namespace {

// The output of SDL's disk driver: raw floats, left and right in turn.
class SoundFile
{
public:
    SoundFile() : m_path(testing::TempDir() + "carom_sound_" + std::to_string(getpid()) + ".raw")
    {
        setenv("SDL_AUDIODRIVER", "disk", 1);
        setenv("SDL_DISKAUDIOFILE", m_path.c_str(), 1);
        // The disk driver waits this long after each buffer; short, so that the test is.
        setenv("SDL_DISKAUDIODELAY", "1", 1);
    }
    ~SoundFile()
    {
        unsetenv("SDL_AUDIODRIVER");
        std::remove(m_path.c_str());
    }
    SoundFile(const SoundFile&) = delete;
    SoundFile& operator=(const SoundFile&) = delete;

    [[nodiscard]] std::vector<float> samples() const
    {
        std::ifstream in(m_path, std::ios::binary | std::ios::ate);
        const auto bytes = in ? static_cast<std::size_t>(in.tellg()) : 0;
        std::vector<float> values(bytes / sizeof(float));
        in.seekg(0);
        in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
        return values;
    }
    [[nodiscard]] std::size_t size() const
    {
        std::ifstream in(m_path, std::ios::binary | std::ios::ate);
        return in ? static_cast<std::size_t>(in.tellg()) : 0;
    }

private:
    std::string m_path;
};

double energy(const std::vector<float>& samples)
{
    double sum = 0;
    for (const float s : samples)
        sum += static_cast<double>(s) * static_cast<double>(s);
    return sum;
}

// A strike's whole energy in the file: independent of how much silence the driver wrote round it.
double heard(float impulse, bool muted = false)
{
    SoundFile file;
    {
        SoundSink sink;
        EXPECT_TRUE(sink.available()) << sink.why_mute();
        sink.set_muted(muted);
        // Let the volume settle, strike, and wait until the decay of 50 ms is on the disk, by the size of the file.
        const auto wait_for = [&](std::size_t bytes)
        {
            const std::size_t goal = file.size() + bytes;
            for (int i = 0; i < 2000 && file.size() < goal; ++i)
                SDL_Delay(5);
            EXPECT_GE(file.size(), goal);
        };
        constexpr std::size_t second = 48000 * 2 * sizeof(float);
        wait_for(second / 4);
        sink.play({.decay_s = 0.05f, .loudness = loudness_of_impulse(impulse, 1)});
        wait_for(second / 2);
    }
    return energy(file.samples());
}

TEST(SoundSink, WhatTheDeviceHearsFollowsTheImpulse)
{
    const double soft = heard(0.05f);
    const double middle = heard(0.25f);
    const double hard = heard(1.0f);
    EXPECT_GT(soft, 0);
    // Five and four times the impulse: the amplitude grows by x^0.6, the energy by its square.
    EXPECT_GT(middle, 3 * soft);
    EXPECT_GT(hard, 3 * middle);
}

TEST(SoundSink, MutedIsSilent) { EXPECT_EQ(heard(1, true), 0); }

TEST(SoundSink, IsMuteAndSaysWhyWithoutADevice)
{
    setenv("SDL_AUDIODRIVER", "no_such_driver", 1);
    SoundSink sink;
    EXPECT_FALSE(sink.available());
    EXPECT_FALSE(sink.why_mute().empty());
    sink.play({});
    sink.set_volume(0.2f);
    sink.set_muted(true);
    sink.set_drone(0, {.loudness = 1});
    sink.stop_all();
    unsetenv("SDL_AUDIODRIVER");
}

TEST(SoundSink, VolumeIsClamped)
{
    setenv("SDL_AUDIODRIVER", "dummy", 1);
    SoundSink sink;
    sink.set_volume(7);
    EXPECT_EQ(sink.volume(), 1);
    sink.set_volume(-1);
    EXPECT_EQ(sink.volume(), 0);
    unsetenv("SDL_AUDIODRIVER");
}

} // namespace
} // namespace carom::view
