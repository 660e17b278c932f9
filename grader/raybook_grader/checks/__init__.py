"""What is looked at in a module, a kind of check each: build, unit, probe and image."""
