// Read once for all sources, in place of once for each. Sources include what they use all the same:
// clang-tidy reads them without this, and so does a build with CMAKE_DISABLE_PRECOMPILE_HEADERS.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>
//
#include <Eigen/Geometry>
