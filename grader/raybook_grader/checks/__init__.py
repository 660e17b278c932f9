"""What is looked at in a module, a kind of check each: build, unit, probe, robust and so on."""
