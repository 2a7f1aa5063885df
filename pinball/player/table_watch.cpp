#include "pinball/player/table_watch.h"

#include <utility>

namespace carom::pinball {

TableWatch::TableWatch(std::filesystem::path file) : m_file(std::move(file)) { (void)poll(); }

bool TableWatch::poll()
{
    std::error_code error;
    const auto time = std::filesystem::last_write_time(m_file, error);
    if (error)
        return false;
    const auto size = std::filesystem::file_size(m_file, error);
    if (error || (time == m_seen && size == m_size))
        return false;
    m_seen = time;
    m_size = size;
    return true;
}

} // namespace carom::pinball
