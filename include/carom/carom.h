#pragma once

/// @file
/// The whole public API. Start with carom::Scene.

#include "carom/body.h"
#include "carom/config.h"
#include "carom/debug_draw.h"
#include "carom/error.h"
#include "carom/event.h"
#include "carom/force_law.h"
#include "carom/function.h"
#include "carom/id.h"
#include "carom/joint.h"
#include "carom/math.h"
#include "carom/query.h"
#include "carom/scene.h"
#include "carom/shape.h"
#include "carom/step_report.h"
