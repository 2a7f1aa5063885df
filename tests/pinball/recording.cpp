// Recorded games: played again they are the same game, and what is no recording is refused with a sentence.

#include "pinball/recording/recording.h"

#include "pinball/autoplay/reflex.h"
#include "pinball/table/loader.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace carom::pinball::test {
namespace {

std::string table_text(const char* name)
{
    std::ifstream in(std::string(CAROM_TABLES_DIR "/") + name + ".table.json");
    return {(std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>()};
}

/// A player of reflexes who also shakes the machine and lets a second player in.
Recording record(const char* name, std::uint64_t seed, int steps)
{
    const std::string text = table_text(name);
    const Table table = load_table(text).table.value();
    const Options options{.seed = seed, .credits = 2};
    Game game(table, options);
    ReflexPlayer player(table, seed);
    Recorder recorder(text, options);
    for (int i = 0; i < steps; ++i)
    {
        Input input = player.play(game);
        input.start |= i == 1500;
        input.nudge_left = i % 3000 < 20;
        input.nudge_up = i % 4500 < 20;
        recorder.note(input);
        game.step(input);
    }
    return recorder.recording(game);
}

Game play_again(Playback& playback)
{
    Game game = playback.new_game();
    while (!playback.is_over())
        game.step(playback.next());
    return game;
}

TEST(Recording, PlayedAgainIsTheSameGame)
{
    for (const char* name : {"momentum", "lab"})
    {
        const Recording first = record(name, 11, 20'000);
        EXPECT_EQ(first.scores.size(), 2u);
        LoadedRecording read = read_recording(first.to_json());
        ASSERT_TRUE(read.recording) << read.trouble;
        EXPECT_EQ(read.recording->changes, first.changes);
        EXPECT_EQ(read.recording->options.credits, 2);
        Playback playback(std::move(*read.recording));
        const Game game = play_again(playback);
        EXPECT_TRUE(playback.came_out_the_same(game)) << name;
        EXPECT_EQ(game.score(0), first.scores[0]);
    }
}

TEST(Recording, AnotherPressIsAnotherGame)
{
    Recording changed = record("momentum", 11, 12'000);
    ASSERT_GT(changed.changes.size(), 8u);
    changed.changes.erase(changed.changes.begin() + 4, changed.changes.begin() + 8);
    Playback playback(changed);
    const Game game = play_again(playback);
    EXPECT_FALSE(playback.came_out_the_same(game));
}

TEST(Recording, WithOtherScoresIsAnotherGame)
{
    Recording forged = record("lab", 1, 3000);
    forged.scores.front() += 1'000'000;
    Playback playback(forged);
    const Game game = play_again(playback);
    EXPECT_FALSE(playback.came_out_the_same(game));
}

TEST(Recording, OfATableWithAnyBytesInItsCommentsIsWritten)
{
    const std::string text = "// caf\xe9\n" + table_text("lab");
    ASSERT_TRUE(load_table(text).table);
    Game game(*load_table(text).table);
    const Recording recording = Recorder(text, {}).recording(game);
    EXPECT_TRUE(read_recording(recording.to_json()).recording);
}

TEST(Recording, WhatIsNoneIsRefusedWithASentence)
{
    const std::string good = record("lab", 1, 3000).to_json();
    const auto with = [&good](const std::string& from, const std::string& to)
    {
        std::string text = good;
        EXPECT_NE(text.find(from), std::string::npos) << from;
        return text.replace(text.find(from), from.size(), to);
    };
    const std::pair<std::string, std::string> cases[] = {
        {"", "not a recorded game"},
        {"{}", "no \"format\""},
        {with("pinball-game", "other"), "\"format\" is not"},
        {good.substr(0, good.size() / 2), "not a recorded game"},
        {with("\"version\":1", "\"version\":9"), "version is 9"},
        {with("\"steps\":3000", "\"steps\":-5"), "\"steps\" must be"},
        {with("\"steps\":3000", "\"steps\":1"), "\"step\" must be"},
        {with("\"steps\":3000", "\"steps\":30.5"), "\"steps\" must be"},
        {with("\"balls_at_once\":1", "\"balls_at_once\":1000000"), "\"balls_at_once\" must be"},
        {with("\"credits\":2", "\"credits\":-1"), "\"credits\" must be"},
        {with("\"ball_save\":true", "\"ball_save\":1"), "\"ball_save\" must be true or false"},
        {with("\"changes\":[[0,", "\"changes\":[[0,128,"), "\"buttons\" must be"},
        {with("\"changes\":[", "\"changes\":[[0,1,256],"), "\"rod\" must be"},
        {with("\"changes\":[", "\"changes\":[5,"), "each of \"changes\""},
        {with("\"seed\":\"1\"", "\"seed\":\"xyz\""), "no hexadecimal number"},
        {with("\"seed\"", "\"sead\""), "seed"},
    };
    for (const auto& [text, sentence] : cases)
    {
        const LoadedRecording loaded = read_recording(text);
        EXPECT_FALSE(loaded.recording);
        EXPECT_NE(loaded.trouble.find(sentence), std::string::npos) << loaded.trouble;
        EXPECT_LT(loaded.trouble.size(), 200u) << loaded.trouble;
    }
    EXPECT_NE(load_recording("no/such/file").trouble.find("cannot read"), std::string::npos);
    LoadedRecording no_table = read_recording(with("\\\"version\\\": 1", "\\\"version\\\": 99"));
    ASSERT_TRUE(no_table.recording) << no_table.trouble;
    EXPECT_THROW(Playback(std::move(*no_table.recording)), std::runtime_error);
}

} // namespace
} // namespace carom::pinball::test
