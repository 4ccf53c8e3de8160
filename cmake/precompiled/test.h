// As standard.h, for tests.
#pragma once

#include "cmake/precompiled/standard.h"
//
#include <gmock/gmock.h>
#include <gtest/gtest.h>
