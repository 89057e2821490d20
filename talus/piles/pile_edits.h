// Changing a pile stone by stone.
#pragma once

#include "talus/piles/pile.h"

namespace talus {

// Each touches the stone's own cube alone; the statistics follow but for `unique`. Throws `Error`
// (usage) if the tiling has no such stone, or it is empty.

// Takes a stone away, wherever it lies.
void remove_stone(Pile& pile, const StoneId& stone);
// Puts a stone where the tiling has it, as it does not move again by itself.
void place_stone(Pile& pile, const StoneId& stone);
// Takes a stone from where the tiling has it, or puts it back first, to where `move` says.
void move_stone(Pile& pile, const StoneMove& move);

// Puts all that `part` has in place of the pile's stones in these cubes: what was filled anew after
// its surroundings changed. Both must be of one tiling.
void replace_part(Pile& pile, const CubeBox& cubes, const Pile& part);

}  // namespace talus
