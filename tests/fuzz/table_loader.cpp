// The table loader must survive any bytes: it gives a table or errors, never both and never neither.

#include "pinball/table/loader.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const carom::pinball::LoadResult result = carom::pinball::load_table(text);
    if (result.table.has_value() != result.errors.empty())
        std::abort();
    for (const carom::pinball::LoadError& error : result.errors)
        if (error.sentence.empty() || to_string(error).empty())
            std::abort();
    return 0;
}
