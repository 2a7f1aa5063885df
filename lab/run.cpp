#include "lab/run.h"

#include <chrono>

namespace carom::lab {
namespace {

// A scene too heavy for real time runs slower instead of locking the window up.
constexpr std::chrono::milliseconds most_work_a_frame{25};

} // namespace

Run::Run(const scenes::SceneEntry& entry, const SceneDef& base) : m_entry(&entry), m_built(entry.create(base))
{
    m_built.scene.set_record_substeps(true);
}

void Run::step()
{
    const StepReport& report = m_built.step(m_entry->h);
    m_history.push_back(report.ms);
    if (m_history.size() > history_steps)
        m_history.pop_front();
    impacts.observe(m_built.scene);
    scrubber.capture(m_built.scene);
}

void Run::advance(double seconds)
{
    if (paused)
        return;
    const auto h = static_cast<double>(m_entry->h);
    const auto end = std::chrono::steady_clock::now() + most_work_a_frame;
    for (m_waiting += seconds * speed; m_waiting >= h; m_waiting -= h)
    {
        if (std::chrono::steady_clock::now() > end)
        {
            m_waiting = 0;
            return;
        }
        step();
    }
}

float Run::alpha() const { return paused ? 1 : static_cast<float>(m_waiting / static_cast<double>(m_entry->h)); }

} // namespace carom::lab
