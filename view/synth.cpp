#include "view/synth.h"

#include "carom/math.h"

#include <algorithm>
#include <cmath>

namespace carom::view {
namespace {

constexpr double two_pi = 6.283185307179586;
constexpr float silence = 1e-4f;
constexpr int attack_samples = 24; // half a millisecond: no click of its own
// A ratio that is no fraction of small numbers rings like metal.
constexpr double modulator_ratio = 2.756;

// Factor per sample for a decay to a thousandth in the given time.
float decay_factor(float seconds, int rate)
{
    return std::exp(-6.9078f / (std::max(seconds, 0.005f) * static_cast<float>(rate)));
}

float approach(float now, float target, float rate) { return now + (target - now) * rate; }

// Straight up to 0.7, then bent: loud moments stay below 1 without a crack.
float soft_limit(float x)
{
    const float size = std::abs(x);
    if (size <= 0.7f)
        return x;
    return std::copysign(0.7f + 0.3f * std::tanh((size - 0.7f) / 0.3f), x);
}

} // namespace

float loudness_of_impulse(float impulse, float full_impulse)
{
    if (!(impulse > 0) || !(full_impulse > 0))
        return 0;
    return std::pow(std::min(impulse / full_impulse, 1.0f), 0.6f);
}

Synth::Synth(int sample_rate) : m_rate(sample_rate) {}

float Synth::next_noise()
{
    m_noise ^= m_noise << 13;
    m_noise ^= m_noise >> 17;
    m_noise ^= m_noise << 5;
    return static_cast<float>(static_cast<std::int32_t>(m_noise)) * (1.0f / 2147483648.0f);
}

void Synth::play(const Strike& strike)
{
    if (!(strike.loudness > silence) || !(strike.pitch_hz > 0))
        return;
    Voice& voice = *std::ranges::min_element(m_voices, {}, [](const Voice& v) { return v.level + v.noise_level; });
    const float noise = std::clamp(strike.noise, 0.0f, 1.0f);
    const float loudness = std::min(strike.loudness, 1.0f);
    const float angle = (std::clamp(strike.pan, -1.0f, 1.0f) + 1) * (pi / 4);
    voice = {};
    voice.step = static_cast<double>(std::min(strike.pitch_hz, 0.45f * static_cast<float>(m_rate))) / m_rate;
    voice.step_factor = std::exp2(static_cast<double>(strike.glide) / (std::max(strike.decay_s, 0.01f) * 0.5 * m_rate));
    voice.level = loudness * (1 - 0.6f * noise);
    voice.level_factor = decay_factor(strike.decay_s, m_rate);
    voice.noise_level = loudness * noise;
    // The noise of the hit is over in a fifth of the ringing.
    voice.noise_factor = decay_factor(strike.decay_s * 0.2f, m_rate);
    voice.brightness = std::clamp(strike.brightness, 0.0f, 1.0f);
    voice.left = std::cos(angle);
    voice.right = std::sin(angle);
    voice.attack = attack_samples;
}

void Synth::set_drone(int index, const Drone& drone)
{
    if (index >= 0 && index < max_drones)
        m_drones[static_cast<std::size_t>(index)].target = drone;
}

void Synth::stop_all()
{
    m_voices = {};
    m_drones = {};
}

int Synth::sounding() const
{
    return static_cast<int>(std::ranges::count_if(m_voices, [](const Voice& v) { return v.level + v.noise_level > silence; }));
}

float Synth::sample(Voice& v)
{
    // Frequency modulation whose depth fades with the loudness: the overtones die first, as in struck things.
    const float depth = v.brightness * v.level * 0.9f;
    const double bend = static_cast<double>(depth) * std::sin(two_pi * v.mod_phase);
    float out = v.level * static_cast<float>(std::sin(two_pi * (v.phase + bend)));
    out += v.noise_level * next_noise();
    v.phase += v.step;
    v.mod_phase += v.step * modulator_ratio;
    v.phase -= std::floor(v.phase);
    v.mod_phase -= std::floor(v.mod_phase);
    v.step *= v.step_factor;
    v.level *= v.level_factor;
    v.noise_level *= v.noise_factor;
    if (v.attack > 0)
        out *= 1 - static_cast<float>(v.attack--) / attack_samples;
    return out;
}

float Synth::sample(HeldVoice& v)
{
    const float rate = 50.0f / static_cast<float>(m_rate);
    v.now.loudness = approach(v.now.loudness, v.target.loudness, rate);
    v.now.pitch_hz = approach(v.now.pitch_hz, v.target.pitch_hz, rate);
    v.now.noise = approach(v.now.noise, v.target.noise, rate);
    v.now.pan = approach(v.now.pan, v.target.pan, rate);
    if (v.now.loudness < silence)
        return 0;
    v.phase += static_cast<double>(v.now.pitch_hz) / m_rate;
    v.phase -= std::floor(v.phase);
    // A state-variable band-pass round the pitch.
    const float f = 2 * std::sin(pi * std::clamp(v.now.pitch_hz / static_cast<float>(m_rate), 0.0f, 0.15f));
    v.low += f * v.band;
    v.band += f * (next_noise() - v.low - 0.7f * v.band);
    const auto tone = static_cast<float>(std::sin(two_pi * v.phase));
    return v.now.loudness * (v.now.noise * v.band * 2 + (1 - v.now.noise) * tone);
}

void Synth::render(std::span<float> stereo)
{
    for (std::size_t i = 0; i + 1 < stereo.size(); i += 2)
    {
        float left = 0;
        float right = 0;
        for (Voice& v : m_voices)
        {
            if (v.level + v.noise_level <= silence)
                continue;
            const float s = sample(v);
            left += s * v.left;
            right += s * v.right;
        }
        for (HeldVoice& v : m_drones)
        {
            if (v.now.loudness < silence && v.target.loudness < silence)
                continue;
            const float s = sample(v);
            left += s * (1 - std::max(v.now.pan, 0.0f)) * 0.7f;
            right += s * (1 + std::min(v.now.pan, 0.0f)) * 0.7f;
        }
        m_volume_now = approach(m_volume_now, m_volume, 100.0f / static_cast<float>(m_rate));
        stereo[i] = soft_limit(left * m_volume_now);
        stereo[i + 1] = soft_limit(right * m_volume_now);
    }
}

} // namespace carom::view
