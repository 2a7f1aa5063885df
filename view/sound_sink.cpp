#include "view/sound_sink.h"

#include <SDL.h>

#include <algorithm>

namespace carom::view {
namespace {

/// Holds the device's callback off while the synth is changed. The callback runs about every 10 ms for a fraction of that.
class DeviceLock
{
public:
    explicit DeviceLock(SDL_AudioDeviceID device) : m_device(device)
    {
        if (m_device != 0)
            SDL_LockAudioDevice(m_device);
    }
    ~DeviceLock()
    {
        if (m_device != 0)
            SDL_UnlockAudioDevice(m_device);
    }
    DeviceLock(const DeviceLock&) = delete;
    DeviceLock& operator=(const DeviceLock&) = delete;

private:
    SDL_AudioDeviceID m_device;
};

} // namespace

void SoundSink::fill(void* sink, std::uint8_t* bytes, int size)
{
    auto* samples = reinterpret_cast<float*>(bytes);
    static_cast<SoundSink*>(sink)->m_synth.render({samples, static_cast<std::size_t>(size) / sizeof(float)});
}

SoundSink::SoundSink()
{
    apply_volume();
    if (SDL_InitSubSystem(SDL_INIT_AUDIO) != 0)
    {
        m_why_mute = SDL_GetError();
        return;
    }
    SDL_AudioSpec want{};
    want.freq = m_synth.sample_rate();
    want.format = AUDIO_F32SYS;
    want.channels = 2;
    want.samples = 512;
    want.callback = &SoundSink::fill;
    want.userdata = this;
    m_device = SDL_OpenAudioDevice(nullptr, 0, &want, nullptr, 0);
    if (m_device == 0)
        m_why_mute = SDL_GetError();
    else
        SDL_PauseAudioDevice(m_device, 0);
}

SoundSink::~SoundSink()
{
    if (m_device != 0)
        SDL_CloseAudioDevice(m_device);
    if (SDL_WasInit(SDL_INIT_AUDIO) != 0)
        SDL_QuitSubSystem(SDL_INIT_AUDIO);
}

void SoundSink::play(const Strike& strike)
{
    // On mute nothing is queued, so that nothing old is heard when sound comes back.
    if (m_device == 0 || m_muted)
        return;
    const DeviceLock lock(m_device);
    m_synth.play(strike);
}

void SoundSink::set_drone(int index, const Drone& drone)
{
    const DeviceLock lock(m_device);
    m_synth.set_drone(index, drone);
}

void SoundSink::stop_all()
{
    const DeviceLock lock(m_device);
    m_synth.stop_all();
}

void SoundSink::set_volume(float volume)
{
    m_volume = std::clamp(volume, 0.0f, 1.0f);
    apply_volume();
}

void SoundSink::set_muted(bool muted)
{
    m_muted = muted;
    apply_volume();
}

void SoundSink::apply_volume()
{
    const DeviceLock lock(m_device);
    // Squared: steps of the number then sound about even.
    m_synth.set_volume(m_muted ? 0 : m_volume * m_volume);
}

} // namespace carom::view
