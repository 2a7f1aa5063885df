// The engine built without exceptions: the handler hears the sentence, the function does nothing and returns a default value.

#include "carom/carom.h"

#include <cmath>
#include <cstdio>
#include <cstring>

#if CAROM_EXCEPTIONS
#error "this program is to be built with -fno-exceptions"
#endif

namespace {

int g_calls = 0;
char g_sentence[512];
int g_failures = 0;

void listen(const char* sentence)
{
    ++g_calls;
    std::snprintf(g_sentence, sizeof g_sentence, "%s", sentence);
}

void expect(bool condition, const char* what)
{
    if (condition)
        return;
    ++g_failures;
    std::printf("failed: %s (last sentence: %s)\n", what, g_sentence);
}

bool says(const char* word) { return std::strstr(g_sentence, word) != nullptr; }

} // namespace

int main()
{
    using namespace carom;
    set_error_handler(listen);
    Scene scene;
    const BodyId ball = scene.create_body({.type = BodyType::Dynamic});
    scene.create_shape(ball, Circle{});
    expect(g_calls == 0, "good input is taken");
    const std::uint64_t before = scene.state_hash();

    scene.step(NAN);
    expect(g_calls == 1 && says("Scene::step") && says("nan"), "a step of NaN");
    expect(scene.step_count() == 0, "no step was taken");
    expect(scene.create_shape(ball, Circle{.radius = -2}).is_null() && g_calls == 2 && says("-2"), "a negative radius");
    expect(scene.create_body({.angle = INFINITY}).is_null() && g_calls == 3, "an infinite angle");
    expect(scene.create_joint(SpringDef{}).is_null() && g_calls == 4, "a spring from the world to the world");
    scene.body(ball).set_velocity({NAN, 0});
    expect(g_calls == 5 && says("Body::set_velocity"), "a velocity of NaN");
    scene.destroy(BodyId{77, 1});
    expect(g_calls == 6 && says("Scene::destroy"), "a stale id");
    expect(scene.overlap_point({NAN, 0}).empty() && g_calls == 7, "a query at NaN");
    expect(box(0, 1).vertices.empty() && g_calls == 8, "a box without width");
    expect(scene.state_hash() == before, "the scene is unchanged");

    scene.destroy(ball);
    const int calls = g_calls;
    static_cast<void>(scene.body(ball).position());
    static_cast<void>(scene.body(ball).shapes());
    scene.body(ball).set_velocity({1, 0});
    expect(g_calls > calls, "a reference to a destroyed body is refused");

    for (int i = 0; i < 10; ++i)
        scene.step(1.0f / 60);
    expect(scene.step_count() == 10, "the scene goes on");
    expect(set_error_handler(nullptr) == listen, "the handler that was replaced is returned");
    std::printf(g_failures == 0 ? "ok\n" : "%d failures\n", g_failures);
    return g_failures == 0 ? 0 : 1;
}
