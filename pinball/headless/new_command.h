#pragma once

namespace carom::pinball {

/// `carom-pinball new FILE [--name NAME] [--with TEMPLATE]...`: writes a table to begin with. The exit code of a program.
int new_command(int argc, char** argv);

} // namespace carom::pinball
