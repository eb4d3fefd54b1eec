#include "apps/batch/object_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace object_cache_test {

using testing::HasSubstr;

object::ObjectFile Named(const std::string& name) {
  object::ObjectFile file;
  file.file = name;
  return file;
}

TEST(ObjectCacheTest, AnObjectIsReadOnceWhileItIsAskedFor) {
  ObjectCache object_cache;
  int reads = 0;
  const auto get = [&](const std::string& key) {
    return object_cache.Get(key, [&] {
      ++reads;
      return Named(key);
    });
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(get("a")->file, "a");
    EXPECT_EQ(get("b")->file, "b");
  }
  EXPECT_EQ(reads, 2);
  // The least recently used object is evicted.
  for (std::size_t i = 0; i < ObjectCache::kMost - 1; ++i) {
    (void)get("other" + std::to_string(i));
    (void)get("a");
  }
  reads = 0;
  (void)get("a");
  EXPECT_EQ(reads, 0);
  (void)get("b");
  EXPECT_EQ(reads, 1);
}

TEST(ObjectCacheTest, WhatCannotBeReadIsTriedOnce) {
  ObjectCache object_cache;
  int reads = 0;
  const auto read = [&]() -> object::ObjectFile {
    ++reads;
    throw InputError("a.obj: is broken");
  };
  for (int i = 0; i < 3; ++i) {
    try {
      (void)object_cache.Get("a", read);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), "a.obj: is broken");
    }
  }
  EXPECT_EQ(reads, 1);
}

using ObjectFinderTest = FolderTest;

TEST_F(ObjectFinderTest, TakesTheNameWhereItsDigestIsRightAndOtherwiseTheDigest) {
  const std::string a = Write("a.obj", "aa").string();
  const std::string b = Write("b.obj", "bb").string();
  ObjectFinder finder(folder_.string());
  EXPECT_EQ(finder.Find("a.obj", "", "q"), a);
  EXPECT_EQ(finder.Find("elsewhere/a.obj", Sha256("aa"), "q"), a);
  EXPECT_EQ(finder.Find("a.obj", Sha256("bb"), "q"), b);
  EXPECT_EQ(finder.Find("renamed.obj", Sha256("bb"), "q"), b);
  // The reader then reports how the digests differ.
  EXPECT_EQ(finder.Find("a.obj", Sha256("cc"), "q"), a);
  for (const char* name : {"gone.obj", "", ".."}) {
    try {
      (void)finder.Find(name, Sha256("cc"), "q.jsonl: line 3");
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("q.jsonl: line 3: /object/file: \""));
    }
  }
  ObjectFinder one(a);
  EXPECT_EQ(one.Find("b.obj", Sha256("bb"), "q"), a);
  EXPECT_FALSE(one.is_folder());
}

}  // namespace object_cache_test
}  // namespace regrasp::apps
