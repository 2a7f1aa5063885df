#pragma once

/// @file
/// Builds the device for each type of element; each of them stands in a file of its own.

#include "pinball/elements/device.h"
#include "pinball/table/table.h"

#include <memory>

namespace carom::pinball {

using DevicePtr = std::unique_ptr<Device>;

DevicePtr make(Playfield&, Index, const Wall&);
DevicePtr make(Playfield&, Index, const Solid&);
DevicePtr make(Playfield&, Index, const Post&);
DevicePtr make(Playfield&, Index, const Plane&);
DevicePtr make(Playfield&, Index, const Flipper&);
DevicePtr make(Playfield&, Index, const Plunger&);
DevicePtr make(Playfield&, Index, const Bumper&);
DevicePtr make(Playfield&, Index, const Slingshot&);
DevicePtr make(Playfield&, Index, const DropTarget&);
DevicePtr make(Playfield&, Index, const Standup&);
DevicePtr make(Playfield&, Index, const SprungTarget&);
DevicePtr make(Playfield&, Index, const Spinner&);
DevicePtr make(Playfield&, Index, const Gate&);
DevicePtr make(Playfield&, Index, const Sensor&);
DevicePtr make(Playfield&, Index, const Booster&);
DevicePtr make(Playfield&, Index, const Kicker&);
DevicePtr make(Playfield&, Index, const Saucer&);
DevicePtr make(Playfield&, Index, const CaptiveBall&);
DevicePtr make(Playfield&, Index, const Light&);

} // namespace carom::pinball
