; A batch is dosed from raw tanks, heated and mixed; then it is the product. Litres and degrees Celsius.
; What was dosed is what has left the raw tank: the recipe is a goal over it.
(define (domain batch-mixer)
  (:requirements :typing :negative-preconditions :disjunctive-preconditions :numeric-fluents)
  (:types raw mixer amount - object)
  (:predicates
    (mixed ?m - mixer))
  (:functions
    (store ?r - raw)                       ; l, in the raw tank
    (dosed ?r - raw)                       ; l, of it in the batch
    (level ?m - mixer)                     ; l
    (heel ?m - mixer)
    (capacity ?m - mixer)
    (temperature ?m - mixer)               ; degC
    (cold)
    (lukewarm)
    (hot)
    (litres ?a - amount)
    (product)
    (effort))

  ; Onto what stays of the last batch, or into one that is neither hot nor mixed yet.
  (:action dose
    :parameters (?r - raw ?m - mixer ?a - amount)
    :precondition (and (or (<= (level ?m) (heel ?m)) (and (not (mixed ?m)) (<= (temperature ?m) (lukewarm))))
                       (>= (store ?r) (litres ?a))
                       (<= (+ (level ?m) (litres ?a)) (capacity ?m)))
    :effect (and (decrease (store ?r) (litres ?a)) (increase (level ?m) (litres ?a))
                 (increase (dosed ?r) (litres ?a)) (assign (temperature ?m) (cold)) (not (mixed ?m))
                 (increase (effort) 1)))

  (:action heat
    :parameters (?m - mixer)
    :precondition (and (> (level ?m) (+ (heel ?m) 5)) (< (temperature ?m) (hot)))
    :effect (and (assign (temperature ?m) (hot)) (increase (effort) 1)))

  (:action mix
    :parameters (?m - mixer)
    :precondition (and (> (level ?m) (+ (heel ?m) 5)) (not (mixed ?m)))
    :effect (and (mixed ?m) (increase (effort) 1)))

  ; The batch becomes product; a new one may be dosed onto what stays in the mixer.
  (:action empty
    :parameters (?m - mixer)
    :precondition (and (mixed ?m) (>= (temperature ?m) (hot)) (> (level ?m) (heel ?m)))
    :effect (and (increase (product) (- (level ?m) (heel ?m))) (assign (level ?m) (heel ?m)) (increase (effort) 1))))
