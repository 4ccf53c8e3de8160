#pragma once

namespace nao {

/** Rectangle of an image, pixels from its lower left corner; `right` and `top` are just outside. */
struct PixelBox {
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  bool is_empty() const { return left >= right || bottom >= top; }
};

}  // namespace nao
