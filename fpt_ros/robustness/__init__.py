"""How much a loop bears: the protocol of RealAIGym, on any experiment."""
