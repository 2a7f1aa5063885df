#pragma once

/// @file
/// A Synth on the sound card. Where there is none it is mute and says why; every call stays legal.
/// SDL_AUDIODRIVER=dummy plays into nothing, SDL_AUDIODRIVER=disk with SDL_DISKAUDIOFILE into a file of raw floats.

#include "view/synth.h"

#include <cstdint>
#include <string>

namespace carom::view {

class SoundSink
{
public:
    SoundSink();
    ~SoundSink();
    SoundSink(const SoundSink&) = delete;
    SoundSink& operator=(const SoundSink&) = delete;

    [[nodiscard]] bool available() const { return m_device != 0; }
    [[nodiscard]] const std::string& why_mute() const { return m_why_mute; } ///< empty where sound is available

    void play(const Strike& strike);
    void set_drone(int index, const Drone& drone);
    void stop_all();

    void set_volume(float volume); ///< 0 to 1, as heard: twice the number sounds about twice as loud
    [[nodiscard]] float volume() const { return m_volume; }
    void set_muted(bool muted);
    [[nodiscard]] bool is_muted() const { return m_muted; }

private:
    static void fill(void* sink, std::uint8_t* bytes, int size);
    void apply_volume();

    Synth m_synth;
    std::uint32_t m_device = 0;
    std::string m_why_mute;
    float m_volume = 0.7f;
    bool m_muted = false;
};

} // namespace carom::view
