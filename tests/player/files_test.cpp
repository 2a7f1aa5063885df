#include "pinball/player/high_score_file.h"
#include "pinball/player/machine.h"
#include "pinball/player/options.h"
#include "pinball/player/table_watch.h"
#include "pinball/table/loader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

namespace carom::pinball {
namespace {

namespace fs = std::filesystem;

class Folder
{
public:
    Folder() : m_path(fs::path(testing::TempDir()) / ("carom_player_" + std::to_string(getpid())))
    {
        fs::create_directories(m_path);
    }
    ~Folder() { fs::remove_all(m_path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] fs::path operator/(const char* name) const { return m_path / name; }

private:
    fs::path m_path;
};

void write(const fs::path& file, const std::string& text)
{
    std::ofstream(file) << text;
    // Some file systems keep times in whole seconds or so: a change must show in any case.
    static int changes = 0;
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(++changes));
}

std::string read(const fs::path& file)
{
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

// As a machine keeps them, one after the other.
std::string add_some(const HighScoreFile& file, const std::string& table)
{
    const std::string first = file.add(table, {"ADA", 5000});
    return first.empty() ? file.add(table, {"BOB", 7000}) : first;
}

HighScores some_scores()
{
    HighScores scores;
    scores.insert({"ADA", 5000});
    scores.insert({"BOB", 7000});
    return scores;
}

TEST(PlayerHighScores, AreKeptForEachTable)
{
    const Folder folder;
    const HighScoreFile file(folder / "scores.json");
    EXPECT_TRUE(file.load("Momentum").entries().empty());
    EXPECT_EQ(add_some(file, "Momentum"), "");
    EXPECT_EQ(file.add("Lab", {"EVE", 10}), "");
    EXPECT_EQ(file.load("Momentum").entries(), some_scores().entries());
    EXPECT_EQ(file.load("Lab").entries().size(), 1u);
}

// Each adds what it has to what the other has written by then.
TEST(PlayerHighScores, TwoMachinesLoseNothing)
{
    const Folder folder;
    const HighScoreFile file(folder / "scores.json");
    std::vector<std::thread> machines;
    for (int m = 0; m < 2; ++m)
        machines.emplace_back(
            [&, m]
            {
                for (int i = 0; i < 5; ++i)
                    EXPECT_EQ(file.add("Momentum", {m == 0 ? "ADA" : "BOB", 100 + 10 * i + m}), "");
            });
    for (std::thread& machine : machines)
        machine.join();
    EXPECT_EQ(file.load("Momentum").entries().size(), static_cast<std::size_t>(HighScores::places));
    EXPECT_EQ(file.load("Momentum").best(), 141);
    EXPECT_FALSE(fs::exists(folder / "scores.json.lock"));
}

TEST(PlayerHighScores, ALockThatACrashHasLeftIsBroken)
{
    const Folder folder;
    const HighScoreFile file(folder / "scores.json");
    std::ofstream(folder / "scores.json.lock") << "";
    fs::last_write_time(folder / "scores.json.lock", fs::file_time_type::clock::now() - std::chrono::minutes(1));
    EXPECT_EQ(file.add("Momentum", {"ADA", 1}), "");
    EXPECT_FALSE(fs::exists(folder / "scores.json.lock"));
}

TEST(PlayerHighScores, ABrokenFileIsPutAsideAndNothingIsLost)
{
    const Folder folder;
    const HighScoreFile file(folder / "scores.json");
    for (const char* broken : {"{\"tables\": {\"Momentum\": [", "[]", "{\"tables\": 3}", "\x01\xff"})
    {
        write(folder / "scores.json", broken);
        EXPECT_TRUE(file.load("Momentum").entries().empty());
        EXPECT_EQ(add_some(file, "Momentum"), "");
        EXPECT_EQ(file.load("Momentum").entries(), some_scores().entries());
        EXPECT_EQ(read(folder / "scores.json.broken"), broken);
    }
}

TEST(PlayerHighScores, EntriesThatAreNoneArePassedOver)
{
    const Folder folder;
    write(folder / "scores.json",
          R"({"tables": {"T": [3, {"name": 1, "score": 2}, {"name": "OK", "score": 9}, {"name": "X"}]}})");
    const HighScores scores = HighScoreFile(folder / "scores.json").load("T");
    ASSERT_EQ(scores.entries().size(), 1u);
    EXPECT_EQ(scores.entries()[0], (HighScore{"OK", 9}));
}

TEST(PlayerHighScores, WithoutAFolderNothingIsKept)
{
    const HighScoreFile file{fs::path{}};
    EXPECT_NE(file.add("T", {"ADA", 1}).find("high scores cannot be kept: "), std::string::npos);
    EXPECT_TRUE(file.load("T").entries().empty());
}

TEST(PlayerTableWatch, SeesEachChangeOnce)
{
    const Folder folder;
    write(folder / "t.json", "1");
    TableWatch watch(folder / "t.json");
    EXPECT_FALSE(watch.poll());
    write(folder / "t.json", "22");
    EXPECT_TRUE(watch.poll());
    EXPECT_FALSE(watch.poll());
    fs::remove(folder / "t.json");
    EXPECT_FALSE(watch.poll());
    write(folder / "t.json", "22");
    EXPECT_TRUE(watch.poll());
}

TEST(PlayerMachine, PlaysTheTableFileAsItChanges)
{
    const Folder folder;
    const std::string text = read(CAROM_TABLES_DIR "/lab.table.json");
    write(folder / "t.json", text);
    Machine machine((folder / "t.json").string(), 1, false, false);
    const std::size_t parts = machine.game().table().elements.size();
    for (int i = 0; i < 50; ++i)
        machine.step({});

    write(folder / "t.json", "{ \"format\": 3 }");
    machine.poll_table();
    ASSERT_FALSE(machine.table_errors().empty());
    EXPECT_EQ(machine.table_errors()[0], to_string(load_table("{ \"format\": 3 }").errors[0]));
    EXPECT_EQ(machine.game().table().elements.size(), parts);
    EXPECT_EQ(machine.game().step_count(), 50);
    machine.step({});

    write(folder / "t.json", text);
    machine.poll_table();
    EXPECT_TRUE(machine.table_errors().empty());
    EXPECT_EQ(machine.game().step_count(), 0);
}

TEST(PlayerMachine, RefusesAFileThatIsNoTable)
{
    const Folder folder;
    write(folder / "t.json", "nothing");
    EXPECT_THROW(Machine((folder / "t.json").string(), 1, false, false), std::runtime_error);
}

TEST(PlayerMachine, DrawingAndListeningDoNotChangeTheGame)
{
    const std::string file = CAROM_TABLES_DIR "/momentum.table.json";
    Machine plain(file, 5, true, false);
    Machine watched(file, 5, true, false);
    watched.record_substeps(true);
    for (int i = 0; i < 6000; ++i)
    {
        plain.step({});
        watched.step({});
        watched.look_into_step();
    }
    EXPECT_EQ(plain.game().state_hash(), watched.game().state_hash());
    EXPECT_GT(plain.game().balls_served(), 0);
}

PlayerOptions parse(std::vector<const char*> words)
{
    words.insert(words.begin(), "carom-pinball");
    const ParsedOptions parsed = parse_options(static_cast<int>(words.size()), words.data());
    EXPECT_TRUE(parsed.options);
    return parsed.options.value_or(PlayerOptions{});
}

TEST(PlayerOptionsTest, AreRead)
{
    const PlayerOptions options =
        parse({"--size", "400x800", "--autoplay", "--seconds", "20", "--seed", "9", "--xray", "--mute"});
    EXPECT_EQ(options.width, 400);
    EXPECT_EQ(options.height, 800);
    EXPECT_EQ(options.seconds, 20);
    EXPECT_EQ(options.seed, 9u);
    EXPECT_TRUE(options.autoplay && options.xray && options.mute);
    EXPECT_FALSE(options.fullscreen);
    EXPECT_TRUE(options.table_file().ends_with("momentum.table.json"));
}

TEST(PlayerOptionsTest, ABadSizeIsRefused)
{
    for (const char* size : {"400", "x", "400x", "0x0", "400x800x2", "99999x800", "-400x800"})
    {
        const char* words[] = {"carom-pinball", "--size", size};
        testing::internal::CaptureStderr();
        EXPECT_FALSE(parse_options(3, words).options) << size;
        testing::internal::GetCapturedStderr();
    }
}

} // namespace
} // namespace carom::pinball
