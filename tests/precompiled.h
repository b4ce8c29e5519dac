#pragma once

// What nearly all tests include, read once for all of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

// JSON values are compiled in json_instance.cpp alone, not in each test: a third of a test's time.
extern template class nlohmann::basic_json<>;
