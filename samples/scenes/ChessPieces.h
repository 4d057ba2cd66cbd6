// SPDX-License-Identifier: MIT
// The six chessmen, after Nathaniel Cook's Staunton set: standing on the origin, facing +X, the king 95 mm high.
#pragma once

#include "Mesh.h"

namespace scenes
{

enum class Piece { Pawn, Rook, Knight, Bishop, Queen, King };

Mesh chessPiece(Piece piece);

/// The knight without its base.
Mesh horseHead();

}  // namespace scenes
