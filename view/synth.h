#pragma once

/// @file
/// Sound made of formulas: short struck voices (a decaying FM sine with a burst of noise) and held drones (rolling,
/// a motor). No assets, no device, no clock: the same calls give the same samples.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace carom::view {

/// Something struck once.
struct Strike
{
    float pitch_hz = 440;
    float brightness = 0.4f; ///< 0: a pure tone; 1: metal, full of overtones
    float noise = 0.2f;      ///< share of noise, 0 to 1: the tick of the hit
    float decay_s = 0.25f;   ///< time to a thousandth of the loudness (60 dB)
    float glide = 0;         ///< octaves by which the pitch rises (or falls) while it decays
    float pan = 0;           ///< -1 left to 1 right
    float loudness = 0.5f;   ///< amplitude, 0 to 1
};

/// Something that sounds until it is set to loudness 0. Changes are smoothed over about 20 ms.
struct Drone
{
    float pitch_hz = 120; ///< of the tone, and where the noise is brightest
    float noise = 1;      ///< 0: tone, 1: noise (a rolling ball)
    float pan = 0;
    float loudness = 0;
};

/// Amplitude for an impact: grows with the impulse, and reaches 1 at full_impulse. An ear hears ratios, so a tenth of
/// the impulse still gives a quarter of the amplitude: x^0.6.
[[nodiscard]] float loudness_of_impulse(float impulse, float full_impulse);

class Synth
{
public:
    static constexpr int max_voices = 48;
    static constexpr int max_drones = 8;

    explicit Synth(int sample_rate = 48000);
    [[nodiscard]] int sample_rate() const { return m_rate; }

    /// Starts a voice; where all are busy, the quietest gives way.
    void play(const Strike& strike);
    void set_drone(int index, const Drone& drone);
    void set_volume(float volume) { m_volume = volume; } ///< 0 to 1, smoothed
    void stop_all();
    [[nodiscard]] int sounding() const;

    /// Writes left and right in turn, and stays within -1 to 1 however many voices sound.
    void render(std::span<float> stereo);

private:
    struct Voice
    {
        double phase = 0; ///< turns
        double mod_phase = 0;
        double step = 0; ///< turns per sample
        double step_factor = 1;
        float level = 0;
        float level_factor = 0;
        float noise_level = 0;
        float noise_factor = 0;
        float brightness = 0;
        float left = 0;
        float right = 0;
        int attack = 0; ///< samples of the fade-in that are left
    };
    struct HeldVoice
    {
        Drone now{};
        Drone target{};
        double phase = 0;
        float low = 0; ///< state of the noise filter
        float band = 0;
    };
    float next_noise();
    float sample(Voice& voice);
    float sample(HeldVoice& voice);

    int m_rate;
    float m_volume = 1;
    float m_volume_now = 1;
    std::uint32_t m_noise = 0x2545f491u;
    std::array<Voice, max_voices> m_voices{};
    std::array<HeldVoice, max_drones> m_drones{};
};

} // namespace carom::view
