#pragma once

namespace hdem
{
/// Three components of a block's motion, or of what acts on it.
struct Triple
{
    double x = 0.0, y = 0.0, w = 0.0;
};
}  // namespace hdem
