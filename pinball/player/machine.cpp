#include "pinball/player/machine.h"

#include "pinball/table/loader.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>

namespace carom::pinball {

namespace {

// Puts the file's text aside as well: a recording holds it.
Table load_or_throw(const std::string& file, std::string& text)
{
    LoadResult result = load_table_file(file);
    text = std::move(result.text);
    if (result.table)
        return std::move(*result.table);
    std::string trouble = file + " is not a table:";
    for (const LoadError& error : result.errors)
        trouble += "\n  " + to_string(error);
    throw std::runtime_error(trouble);
}

// A shorter game is not worth keeping.
constexpr double shortest_kept_game = 5; // s

// Shapes carry the index of their element plus one, balls the highest bit (Playfield).
std::string name_of(const Table& table, std::uint64_t tag)
{
    if (tag >> 63 != 0)
        return "ball";
    if (tag == 0 || tag > table.elements.size())
        return "table";
    std::string name = table.elements[static_cast<std::size_t>(tag - 1)].id;
    std::ranges::replace(name, '_', ' ');
    return name;
}

} // namespace

Machine::Machine(const std::string& file, std::uint64_t seed, bool autoplay, bool keep_scores)
    : impacts(namer()), m_watch(file), m_seeds(seed), m_seed(seed), m_autoplay(autoplay),
      m_game(load_or_throw(file, m_table_text), {.seed = seed}), m_effects(m_game.table()), m_art(m_game.table())
{
    if (keep_scores)
    {
        m_score_file = HighScoreFile::of_user();
        m_game_files = GameFiles::of_user();
        m_score_trouble = controls.load(Controls::file_of_user());
    }
    load_scores();
    if (m_autoplay)
        m_player.emplace(m_game.table(), m_seed);
}

view::ShapeNamer Machine::namer() const
{
    return [this](const Scene& scene, ShapeId shape) { return name_of(m_game.table(), scene.shape(shape).user_data()); };
}

void Machine::load_scores()
{
    if (m_score_file)
        m_game.set_high_scores(m_score_file->load(m_game.table().name));
}

Machine::~Machine()
{
    try
    {
        end_game();
        keep_scores();
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "carom-pinball: %s\n", error.what());
    }
}

void Machine::keep_score(int rank)
{
    if (m_score_file)
        m_score_trouble = m_score_file->add(m_game.table().name, m_game.high_scores().entries()[static_cast<std::size_t>(rank)]);
}

void Machine::keep_named_score()
{
    m_game.rename_score(m_name_entry.rank(), m_name_entry.name());
    keep_score(m_name_entry.rank());
}

// Those that wait for a name go to the file without one, and what is being written as far as it has come.
void Machine::keep_scores()
{
    if (m_name_entry.active())
        keep_named_score();
    for (const GameEvent& event : m_unnamed)
        keep_score(event.value);
    m_name_entry = {};
    m_unnamed.clear();
}

void Machine::ask_for_name()
{
    if (m_name_entry.active() || m_unnamed.empty())
        return;
    m_name_entry.begin(m_unnamed.front().value, m_game.players() > 1 ? m_unnamed.front().ball : -1);
    m_unnamed.pop_front();
}

void Machine::step(Input input)
{
    if (m_playback)
        return step_watched();
    if (m_player)
        input = m_player->play(m_game);
    if (m_name_entry.step(input))
        keep_named_score();
    input = m_name_entry.leaves_over(input);
    if (input.start && !m_start_was_down && is_idle())
        begin_game();
    m_start_was_down = input.start;
    if (m_recorder)
        m_recorder->note(input);
    m_times.measure([&] { m_game.step(input); });
    for (const GameEvent& event : m_game.events())
    {
        if (event.kind == EventKind::GameEnded)
            end_game();
        if (event.kind == EventKind::HighScore)
        {
            if (m_player)
                keep_score(event.value);
            else
                m_unnamed.push_back(event);
        }
    }
    ask_for_name();
    m_effects.observe(m_game);
    impacts.observe(m_game.scene());
}

Game Machine::put(Game game)
{
    game.set_high_scores(m_game.high_scores());
    Game old = std::exchange(m_game, std::move(game));
    m_art = TableArt(m_game.table());
    ++m_table_version;
    forget_what_was_seen();
    return old;
}

void Machine::forget_what_was_seen()
{
    m_effects = Effects(m_game.table());
    impacts.clear();
    scrubber.clear();
    selected = {};
    m_game.record_substeps(m_record);
}

// The first one is played with the seed of the program's command line.
void Machine::begin_game()
{
    end_game();
    Options options{.seed = m_seed, .credits = m_game.credits()};
    m_seed = m_seeds.bits();
    m_recorder.emplace(m_table_text, options);
    const std::uint64_t version = m_table_version;
    put(Game(m_game.table(), options));
    m_table_version = version; // the same table
}

void Machine::end_game()
{
    if (!m_recorder)
        return;
    m_last_game = std::exchange(m_recorder, std::nullopt)->recording(m_game);
    const double played = static_cast<double>(m_last_game->steps) * static_cast<double>(m_game.table().physics.step);
    if (m_game_files && !m_player && played >= shortest_kept_game)
        if (std::string trouble = m_game_files->add(*m_last_game); !trouble.empty())
            m_score_trouble = std::move(trouble);
}

std::string Machine::watch(const std::filesystem::path& file)
{
    LoadedRecording loaded = load_recording(file);
    return loaded.recording ? watch(std::move(*loaded.recording)) : loaded.trouble;
}

std::string Machine::watch_last()
{
    if (m_last_game)
        return watch(*m_last_game);
    const auto file = m_game_files ? m_game_files->newest() : std::nullopt;
    return file ? watch(*file) : "no game has been recorded yet";
}

std::string Machine::watch(Recording recording)
try
{
    Playback playback(std::move(recording));
    stop_watching();
    end_game();
    keep_scores();
    m_own_game = put(playback.new_game());
    m_playback = std::move(playback);
    return {};
}
catch (const std::exception& error)
{
    return error.what();
}

void Machine::stop_watching()
{
    if (!m_playback)
        return;
    m_playback.reset();
    put(std::move(*m_own_game));
    m_own_game.reset();
}

void Machine::step_watched()
{
    if (m_playback->is_over())
        return;
    m_game.step(m_playback->next());
    m_game.set_high_scores(m_own_game->high_scores()); // its score has been there once
    m_came_out_the_same = m_playback->is_over() && m_playback->came_out_the_same(m_game);
    m_effects.observe(m_game);
    impacts.observe(m_game.scene());
}

void Machine::begin(Table table, std::string text)
{
    stop_watching();
    m_recorder.reset(); // half of it was another table
    keep_scores();
    const bool same = table.name == m_game.table().name;
    m_table_text = std::move(text);
    put(Game(std::move(table), {.seed = m_seed, .credits = m_game.credits()}));
    if (!same)
        load_scores();
    if (m_autoplay)
        m_player.emplace(m_game.table(), m_seed);
}

void Machine::restart()
{
    stop_watching();
    end_game();
    keep_scores();
    m_game.restart();
    if (m_autoplay)
        m_player.emplace(m_game.table(), m_seed);
    forget_what_was_seen();
}

void Machine::play_by_itself(bool on)
{
    m_autoplay = on;
    m_player.reset();
    if (on)
        m_player.emplace(m_game.table(), m_seed);
}

bool Machine::poll_table()
{
    if (!m_watch.poll())
        return false;
    LoadResult result = load_table_file(m_watch.file());
    m_table_errors.clear();
    for (const LoadError& error : result.errors)
        m_table_errors.push_back(to_string(error));
    if (!result.table)
        return false;
    begin(std::move(*result.table), std::move(result.text));
    return true;
}

void Machine::look_into_step()
{
    if (m_record)
        scrubber.capture(m_game.scene());
}

void Machine::record_substeps(bool record)
{
    if (m_record == record)
        return;
    m_record = record;
    m_game.record_substeps(record);
    if (!record)
        scrubber.clear();
}

} // namespace carom::pinball
